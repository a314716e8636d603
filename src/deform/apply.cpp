#include "deform/apply.h"

namespace viete::deform {

namespace {

Vec3 times(const sym3::Sym3<double>& s, const Vec3& x) {
  return {s.xx * x[0] + s.xy * x[1] + s.xz * x[2], s.xy * x[0] + s.yy * x[1] + s.yz * x[2],
          s.xz * x[0] + s.yz * x[1] + s.zz * x[2]};
}

Vec3 times(const sym3::Mat3<double>& m, const Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

}  // namespace

void apply(const Binding& binding, const BlendedLogs& sums, std::span<const sym3::Sym3<double>> stretches,
           const Vec3& origin, std::size_t begin, std::size_t end, std::span<mesh::Point> positions) {
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 stretched = times(stretches[i], binding.offsets[i]);
    positions[i] = origin + (times(sym3::exp_rotation(sums.rotation[i]), stretched) + sums.center[i]);
  }
}

void apply(const Binding& binding, const BlendedMaps& sums, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions) {
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 x = binding.rest[i] - binding.rest_origin;
    positions[i] = origin + (x + (times(sums.linear[i], x) + sums.shift[i]));
  }
}

void apply(const Binding& binding, std::span<const Vec3> sums, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions) {
  for (std::size_t i = begin; i < end; ++i) positions[i] = origin + (sums[i] + binding.offsets[i]);
}

}  // namespace viete::deform
