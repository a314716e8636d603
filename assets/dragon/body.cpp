#include "dragon/anatomy.h"
#include "dragon/spine.h"

namespace viete::dragon {
namespace {

/// One shingle of a brick pattern: high in its middle, falling to nothing at its rim.
double shingle(double along, double around) {
  const double row = std::floor(along);
  const double shifted = around + 0.5 * (row - 2 * std::floor(row / 2));
  const double x = along - row, y = 2 * (shifted - std::floor(shifted)) - 1;
  const double rim = 1 - y * y;
  // Steep at the tail end, gentle towards the head: scales overlap backwards.
  const double rise = x < 0.25 ? x / 0.25 : (1 - x) / 0.75;
  return rim * rise * (2 - rise);
}

double scale_height(const TubePoint& p) {
  return std::min(0.055 * p.radius, 0.0065);
}

/// Scales on the back and sides, broad plates below.
double hide(const TubePoint& p) {
  const double belly = smooth_step(0.66, 0.74, std::abs(p.around));
  const double plate = 3.2 * p.along - std::floor(3.2 * p.along);
  const double plate_rise = plate < 0.2 ? plate / 0.2 : (1 - plate) / 0.8;
  const double plates = plate_rise * (2 - plate_rise);
  return scale_height(p) * lerp(shingle(3.6 * p.along, 8 * p.around), 1.3 * plates, belly);
}

}  // namespace

double leg_scales(const TubePoint& p) {
  return scale_height(p) * shingle(3.2 * p.along, 7 * p.around) * smooth_step(0.028, 0.055, p.radius);
}

const std::vector<Station>& spine() {
  static const std::vector<Station> stations{
      // tail
      {{-1.575, 0.42, 0.01}, .010, .010, .010},
      {{-1.48, 0.275, 0.125}, .019, .019, .017},
      {{-1.315, 0.175, 0.21}, .028, .028, .026},
      {{-1.11, 0.145, 0.22}, .039, .040, .037},
      {{-0.905, 0.195, 0.16}, .053, .055, .050},
      {{-0.70, 0.32, 0.07}, .072, .076, .070},
      {{-0.51, 0.465, 0.015}, .100, .105, .098},
      // trunk
      {{-0.30, 0.575, 0.00}, .134, .135, .125},
      {{-0.08, 0.61, 0.00}, .134, .126, .138},
      {{0.14, 0.62, 0.00}, .156, .142, .192},
      {{0.30, 0.665, 0.00}, .142, .132, .182},
      // neck
      {{0.435, 0.765, 0.00}, .108, .110, .130},
      {{0.530, 0.885, 0.00}, .083, .087, .098},
      {{0.545, 1.025, 0.00}, .068, .072, .077},
      {{0.510, 1.160, 0.00}, .060, .063, .066},
      {{0.520, 1.285, 0.005}, .055, .059, .060},
      {{0.595, 1.370, 0.015}, .053, .056, .056},
      {{0.690, 1.395, 0.035}, .052, .055, .054},
  };
  return stations;
}

void add_body(Field& field) {
  field.join(std::make_unique<Tube>(spine(), kSideways, hide), 0.01);
}

}  // namespace viete::dragon
