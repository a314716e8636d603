#include "deform/vertex_sample.h"

#include "deform/exact.h"
#include "deform/inverse_distance.h"
#include "deform/map_rows.h"

namespace viete::deform {

namespace {

constexpr std::size_t error_sample = 512;  // vertices

}  // namespace

std::vector<std::size_t> spread_vertices(const Binding& binding, std::size_t limit) {
  std::vector<std::size_t> vertices(std::min(binding.vertices, limit));
  for (std::size_t s = 0; s < vertices.size(); ++s) vertices[s] = s * binding.vertices / vertices.size();
  return vertices;
}

BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points) {
  BoundPart part;
  Binding& b = part.binding;
  b.weighting = weigher.weighting();
  b.vertices = points.size();
  b.handles = weigher.handles();
  b.rest.assign(points.begin(), points.end());
  b.rest_origin = weigher.origin();
  b.weights.reserve(b.vertices * b.handles);
  b.offsets.reserve(b.vertices);
  part.failed = visit_weights(weigher, points, [&](std::size_t i, const std::vector<double>& weights) {
    b.weights.insert(b.weights.end(), weights.begin(), weights.end());
    b.offsets.push_back(
        rest_offset(weigher.cage(), weigher.handle_positions(), points[i] - weigher.origin(), weights));
  });
  return part;
}

double sampled_error(const Weigher& weigher, const Binding& binding, const Rows& rows,
                     std::span<const FrameVertex> frame) {
  const auto vertices = spread_vertices(binding, error_sample);
  std::vector<mesh::Point> exact;
  for (const auto v : vertices) exact.push_back(binding.rest[v]);
  const BoundPart part = bind_part(weigher, exact);
  place_vertices(part.binding, rows, sym3::Method::fast, exact);
  double worst = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto& p = frame[vertices[i]].position;
    worst = std::max(worst, norm(rows.origin + Vec3{p[0], p[1], p[2]} - exact[i]));
  }
  return worst / weigher.cage().diagonal;
}

std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 const Rows& rows, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 1024;
  std::vector<sym3::Sym3<double>> sample;
  if (!has_stretch_logs(rows.form)) return sample;
  std::vector<mesh::Point> points;
  for (const auto v : spread_vertices(binding, limit)) points.push_back(binding.rest[v]);
  sample.reserve(points.size());
  visit_weights(weigher, points, [&](std::size_t, const std::vector<double>& weights) {
    if (progress && sample.size() % portion == 0) {
      progress->report(static_cast<double>(sample.size()) / static_cast<double>(points.size()));
    }
    sym3::Sym3<double> m{};
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double w = weights[j];
      const double* x = rows.values.data() + j * rows.columns();
      m = {m.xx + w * x[0], m.xy + w * x[1], m.xz + w * x[2],
           m.yy + w * x[3], m.yz + w * x[4], m.zz + w * x[5]};
    }
    sample.push_back(m);
  });
  return sample;
}

}  // namespace viete::deform
