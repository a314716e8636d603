#include "scene/document/space.h"

#include <cmath>

namespace viete::scene {

double grid_cell(double diagonal) {
  if (!(diagonal > 0) || !std::isfinite(diagonal)) return 1;
  const double wanted = diagonal / 20;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  const double mantissa = wanted / decade;
  return decade * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

Space space_for(const mesh::Bounds& box) {
  const double diagonal = box.diagonal();
  return {box.center(), diagonal > 0 ? 2.0 / diagonal : 1.0};
}

}  // namespace viete::scene
