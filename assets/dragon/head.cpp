#include <vector>

#include "dragon/anatomy.h"
#include "dragon/ball.h"
#include "dragon/spine.h"

namespace viete::dragon {
namespace {

/// The head's own axes: forward along the muzzle, up, and left; it looks a little to its left, and down its
/// nose.
class Head {
public:
  Head() {
    forward_ = normalized({0.90, -0.20, 0.28});
    left_ = normalized(cross(forward_, {0, 1, 0}));
    up_ = cross(left_, forward_);
  }
  /// A point of the head; side is +1 or -1 and mirrors.
  Vec3 at(double forward, double up, double left) const {
    return origin_ + (forward_ * forward + up_ * up + left_ * left) * kSize;
  }
  Station station(double forward, double up, double left, double across, double above, double below) const {
    return {at(forward, up, left), across * kSize, above * kSize, below * kSize};
  }
  Station ring(double forward, double up, double left, double radius) const {
    return station(forward, up, left, radius, radius, radius);
  }
  void join(Field& field, const std::vector<Station>& stations, double blend, Relief relief = nullptr) const {
    field.join(std::make_unique<Tube>(stations, left_, relief), blend * kSize);
  }

private:
  static constexpr double kSize = 1.22;
  Vec3 origin_ = spine().back().at;
  Vec3 forward_, left_, up_;
};

void add_skull(Field& field, const Head& head) {
  head.join(
      field,
      {head.station(-0.075, 0.000, 0, .040, .044, .040), head.station(-0.030, 0.010, 0, .066, .056, .044),
       head.station(0.025, 0.012, 0, .069, .055, .036), head.station(0.080, 0.006, 0, .056, .046, .026),
       head.station(0.140, -0.002, 0, .043, .036, .022), head.station(0.205, -0.008, 0, .038, .032, .022),
       head.station(0.250, -0.012, 0, .036, .030, .022), head.station(0.276, -0.018, 0, .024, .020, .016)},
      0.03);
  head.join(
      field,  // lower jaw, a little open
      {head.station(-0.050, -0.030, 0, .048, .030, .036), head.station(0.010, -0.064, 0, .050, .022, .030),
       head.station(0.080, -0.092, 0, .040, .017, .024), head.station(0.150, -0.116, 0, .032, .016, .020),
       head.station(0.210, -0.132, 0, .027, .015, .018), head.station(0.238, -0.136, 0, .018, .011, .013)},
      0.022);
}

void add_tongue(Field& field, const Head& head) {
  head.join(
      field,
      {head.station(0.000, -0.062, 0, .020, .014, .014), head.station(0.080, -0.082, 0, .020, .012, .012),
       head.station(0.140, -0.098, 0, .018, .011, .010), head.station(0.185, -0.100, 0, .013, .009, .008),
       head.station(0.212, -0.090, 0, .006, .006, .006)},
      0.006);
}

void add_face(Field& field, const Head& head, double side) {
  // Brow, nose ridge, cheek.
  head.join(field,
            {head.ring(0.120, 0.036, .024 * side, .010), head.ring(0.080, 0.056, .042 * side, .017),
             head.ring(0.030, 0.066, .056 * side, .019), head.ring(-0.020, 0.070, .064 * side, .015),
             head.ring(-0.060, 0.078, .070 * side, .006)},
            0.022);
  head.join(field,
            {head.ring(0.130, 0.034, .012 * side, .010), head.ring(0.200, 0.024, .020 * side, .011),
             head.ring(0.246, 0.018, .022 * side, .016)},
            0.010);
  head.join(field,
            {head.ring(0.100, -0.012, .046 * side, .012), head.ring(0.030, -0.020, .062 * side, .020),
             head.ring(-0.040, -0.026, .064 * side, .020)},
            0.020);
  head.join(field,  // lower lid
            {head.ring(0.108, 0.020, .046 * side, .007), head.ring(0.064, -0.004, .066 * side, .010),
             head.ring(0.014, 0.012, .068 * side, .008)},
            0.010);
  field.carve(std::make_unique<Ball>(head.at(0.266, 0.021, .027 * side), 0.0125), 0.006);
  field.carve(std::make_unique<Ball>(head.at(0.062, 0.024, .082 * side), 0.0310), 0.008);
  field.join(std::make_unique<Ball>(head.at(0.062, 0.024, .046 * side), 0.0240), 0.002);
}

void add_teeth(Field& field, const Head& head, double side) {
  for (double forward : {0.256, 0.222, 0.190, 0.158, 0.126}) {
    const double long_one = forward > 0.23 ? 0.034 : 0.022;
    const double out = (0.020 + 0.10 * (0.276 - forward)) * side;
    const double root = -0.030;
    head.join(
        field,
        {head.ring(forward, root + 0.012, out, .0085), head.ring(forward, root - 0.4 * long_one, out, .0065),
         head.ring(forward - 0.004, root - long_one, out, .0045)},
        0.004);
  }
  for (double forward : {0.214, 0.176, 0.138}) {
    const double out = (0.014 + 0.08 * (0.238 - forward)) * side;
    const double root = -0.122 + 0.33 * (0.214 - forward);
    head.join(field,
              {head.ring(forward, root, out, .008), head.ring(forward, root + 0.018, out, .006),
               head.ring(forward - 0.003, root + 0.030, out, .0045)},
              0.004);
  }
}

/// Rings about a horn, as on a ram's, that die out towards its tip.
double horn_rings(const TubePoint& p) {
  const double ring = 1.4 * p.along - std::floor(1.4 * p.along);
  const double swell = 4 * ring * (1 - ring);
  return 0.0042 * swell * smooth_step(0.008, 0.024, p.radius) * smooth_step(0.5, 2.0, p.along);
}

void add_horns(Field& field, const Head& head, double side) {
  head.join(field, horn(side), 0.014, horn_rings);
  head.join(field,
            {head.ring(-0.040, 0.010, .056 * side, .019), head.ring(-0.095, 0.022, .088 * side, .015),
             head.ring(-0.150, 0.030, .112 * side, .010), head.ring(-0.195, 0.046, .122 * side, .0045)},
            0.012);
  head.join(field,
            {head.ring(-0.030, -0.030, .050 * side, .016), head.ring(-0.075, -0.040, .080 * side, .012),
             head.ring(-0.125, -0.044, .100 * side, .0045)},
            0.010);
  head.join(field,
            {head.ring(0.040, -0.082, .036 * side, .012), head.ring(0.005, -0.108, .048 * side, .009),
             head.ring(-0.030, -0.124, .056 * side, .0045)},
            0.010);
}

}  // namespace

Station muzzle() {
  return Head().ring(0.260, -0.060, 0, .060);
}

std::vector<Station> horn(double side) {
  const Head head;
  return {head.ring(-0.020, 0.045, .040 * side, .026), head.ring(-0.075, 0.085, .058 * side, .024),
          head.ring(-0.150, 0.110, .082 * side, .019), head.ring(-0.225, 0.125, .098 * side, .014),
          head.ring(-0.285, 0.150, .097 * side, .009), head.ring(-0.325, 0.185, .088 * side, .0045)};
}

void add_head(Field& field) {
  const Head head;
  add_skull(field, head);
  add_tongue(field, head);
  for (double side : {1.0, -1.0}) {
    add_face(field, head, side);
    add_teeth(field, head, side);
    add_horns(field, head, side);
  }
}

}  // namespace viete::dragon
