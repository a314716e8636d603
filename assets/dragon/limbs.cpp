#include <vector>

#include "dragon/anatomy.h"
#include "dragon/spine.h"

namespace viete::dragon {
namespace {

using Stations = std::vector<Station>;

Stations shifted(Stations stations, double ahead, double side) {
  for (Station& s : stations) s.at = {s.at.x + ahead, s.at.y, s.at.z * side};
  return stations;
}

/// A toe with its claw, from the ankle along the ground; spread turns it outwards.
void add_toe(Field& field, Vec3 root, Vec3 direction, double size) {
  const auto at = [&](double forward, double height) {
    return root + direction * (forward * size) + Vec3{0, height * size, 0};
  };
  const Stations toe{round(at(0, 0.030), 0.030 * size), round(at(0.035, 0.040), 0.026 * size),
                     round(at(0.070, 0.034), 0.021 * size), round(at(0.098, 0.022), 0.020 * size)};
  const Vec3 across = normalized(cross(direction, {0, 1, 0}));
  field.join(std::make_unique<Tube>(toe, across), 0.022);
  const Stations claw{round(at(0.095, 0.030), 0.014 * size), round(at(0.120, 0.030), 0.0115 * size),
                      round(at(0.145, 0.019), 0.008 * size), round(at(0.162, 0.006), 0.0045 * size)};
  field.join(std::make_unique<Tube>(claw, across), 0.004);
}

/// Three toes forwards, one back.
void add_foot(Field& field, Vec3 heel, double side, double size) {
  for (double spread : {-0.42, 0.04, 0.50}) add_toe(field, heel, normalized({1, 0, spread * side}), size);
  add_toe(field, heel + Vec3{-0.012, 0, -0.012 * side}, normalized({-1, 0, -0.25 * side}), 0.62 * size);
}

constexpr double kHindHeel = -0.288, kFrontHeel = 0.288;

/// One step ahead with the left feet, and the hind one behind.
double forward(bool hind, double side) {
  if (side < 0) return 0;
  return hind ? -0.04 : 0.05;
}

void add_leg(Field& field, bool hind, double side) {
  field.join(std::make_unique<Tube>(leg(hind, side), kSideways, leg_scales), 0.05);
  const double heel = (hind ? kHindHeel : kFrontHeel) + forward(hind, side);
  add_foot(field, {heel, 0, (hind ? 0.222 : 0.212) * side}, side, hind ? 1.28 : 1.25);
}

}  // namespace

std::vector<Station> leg(bool hind, double side) {
  const Stations hind_leg{
      {{-0.31, 0.60, 0.085}, .085, .125, .115},   {{-0.265, 0.49, 0.150}, .092, .148, .125},
      {{-0.205, 0.375, 0.200}, .072, .105, .090}, {{-0.195, 0.290, 0.220}, .053, .063, .060},
      {{-0.270, 0.210, 0.222}, .040, .043, .050}, {{-0.335, 0.138, 0.220}, .032, .034, .038},
      {{-0.318, 0.082, 0.220}, .031, .032, .033}, {{kHindHeel, 0.038, 0.222}, .035, .036, .035}};
  const Stations front_leg{
      {{0.225, 0.67, 0.100}, .072, .105, .095},  {{0.235, 0.555, 0.155}, .076, .108, .096},
      {{0.205, 0.440, 0.190}, .060, .078, .072}, {{0.178, 0.345, 0.204}, .046, .052, .053},
      {{0.212, 0.245, 0.208}, .041, .044, .045}, {{0.250, 0.145, 0.209}, .033, .034, .034},
      {{0.268, 0.080, 0.210}, .031, .032, .032}, {{kFrontHeel, 0.038, 0.212}, .035, .035, .035}};
  return shifted(hind ? hind_leg : front_leg, forward(hind, side), side);
}

void add_limbs(Field& field) {
  for (bool hind : {true, false}) {
    for (double side : {1.0, -1.0}) add_leg(field, hind, side);
  }
}

}  // namespace viete::dragon
