#include <vector>

#include "dragon/anatomy.h"
#include "dragon/spine.h"

namespace viete::dragon {
namespace {

/// A thin blade on the back, leaning backwards.
void add_blade(Field& field, Vec3 root, Vec3 backward, Vec3 up, double height) {
  const auto at = [&](double back, double high) {
    return root + backward * (back * height) + up * (high * height);
  };
  const double thin = 0.10 * height + 0.003;
  const std::vector<Station> blade{{at(0.00, -0.35), thin * 1.6, 0.42 * height, 0.42 * height},
                                   {at(0.14, 0.20), thin * 1.2, 0.34 * height, 0.30 * height},
                                   {at(0.33, 0.65), thin, 0.19 * height, 0.16 * height},
                                   {at(0.56, 1.00), 0.0045, 0.005, 0.005}};
  field.join(std::make_unique<Tube>(blade, cross(up, backward)), 0.010);
}

/// Blades from the tail to the head, closer where the body is thin.
void add_blades(Field& field) {
  const std::vector<Station>& line = spine();
  const int last = static_cast<int>(line.size()) - 1;
  double gap = 0;
  constexpr int kSteps = 16;
  for (int i = kSteps; i < last * kSteps; ++i) {
    const int span = i / kSteps;
    const double t = static_cast<double>(i % kSteps) / kSteps;
    const Station &a = line[span], &b = line[span + 1];
    const double above = lerp(a.above, b.above, t);
    const double height = 0.032 + 0.42 * above * (1 - 0.4 * smooth_step(0.09, 0.13, above));
    gap += length(b.at - a.at) / kSteps;
    if (gap < 0.024 + 0.80 * height) continue;
    gap = 0;
    const Vec3 forward =
        normalized(lerp(b.at - line[std::max(span - 1, 0)].at, line[std::min(span + 2, last)].at - a.at, t));
    const Vec3 up = normalized(cross(kSideways, forward));
    add_blade(field, lerp(a.at, b.at, t) + up * above, forward * -1, up, height);
  }
}

void add_spade(Field& field) {
  const Station& tip = spine().front();
  const Vec3 outward = normalized(tip.at - spine()[1].at);
  const auto at = [&](double along) { return tip.at + outward * along; };
  const std::vector<Station> spade{{at(-0.03), .012, .012, .012}, {at(0.01), .016, .040, .040},
                                   {at(0.035), .016, .068, .068}, {at(0.085), .014, .046, .046},
                                   {at(0.14), .010, .020, .020},  {at(0.185), .006, .006, .006}};
  field.join(std::make_unique<Tube>(spade, Vec3{0.2, 0.3, 1}), 0.010);
}

}  // namespace

void add_crest(Field& field) {
  add_blades(field);
  add_spade(field);
}

}  // namespace viete::dragon
