#include "deform/vertex_sample.h"

#include "deform/vec3.h"

namespace viete::deform {

std::vector<std::size_t> spread_vertices(const Binding& binding, std::size_t limit) {
  std::vector<std::size_t> vertices(std::min(binding.vertices, limit));
  for (std::size_t s = 0; s < vertices.size(); ++s) vertices[s] = s * binding.vertices / vertices.size();
  return vertices;
}

Binding part_of(const Weigher& weigher, const Binding& binding, std::span<const std::size_t> vertices) {
  Binding part;
  part.coordinates = binding.coordinates;
  part.reach = binding.reach;
  part.vertices = vertices.size();
  part.handles = binding.handles;
  visit_vertices(weigher, binding, vertices, [&](std::size_t vertex, const std::vector<double>& weights) {
    part.weights.insert(part.weights.end(), weights.begin(), weights.end());
    Vec3 sum{0, 0, 0};
    for (std::size_t j = 0; j < weights.size(); ++j) sum = sum + weights[j] * weigher.handle_positions()[j];
    part.offsets.push_back((binding.rest[vertex] - weigher.origin()) - sum);
  });
  return part;
}

std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 std::span<const MapLog> logs, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 1024;
  std::vector<sym3::Sym3<double>> sample;
  if (logs.empty()) return sample;
  const auto vertices = spread_vertices(binding, limit);
  sample.reserve(vertices.size());
  visit_vertices(weigher, binding, vertices, [&](std::size_t, const std::vector<double>& weights) {
    if (progress && sample.size() % portion == 0) {
      progress->report(static_cast<double>(sample.size()) / static_cast<double>(vertices.size()));
    }
    sym3::Sym3<double> m{};
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double w = weights[j];
      const auto& x = logs[j].stretch;
      m = {m.xx + w * x.xx, m.xy + w * x.xy, m.xz + w * x.xz,
           m.yy + w * x.yy, m.yz + w * x.yz, m.zz + w * x.zz};
    }
    sample.push_back(m);
  });
  return sample;
}

}  // namespace viete::deform
