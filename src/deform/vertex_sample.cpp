#include "deform/vertex_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deform/maps.h"
#include "deform/point_weights.h"
#include "deform/scheme.h"
#include "deform/staged_engine.h"

namespace viete::deform {

namespace {

VertexSum::Term term_of(const Rows& rows, bool has_logs, std::size_t handle, double weight) {
  VertexSum::Term term{static_cast<std::uint32_t>(handle), weight};
  if (!has_logs) return term;
  const double* x = rows.values.data() + handle * rows.columns();
  term.stretch = {x[0], x[1], x[2], x[3], x[4], x[5]};
  term.turn = {x[6], x[7], x[8]};
  const double* center = x + shape(rows.form).center;
  term.at = rows.origin + Vec3{center[0], center[1], center[2]};
  return term;
}

void add(const VertexSum::Term& term, VertexSum& sum) {
  const auto& x = term.stretch;
  auto& s = sum.stretch;
  const double w = term.weight;
  s = {s.xx + w * x.xx, s.xy + w * x.xy, s.xz + w * x.xz, s.yy + w * x.yy, s.yz + w * x.yz, s.zz + w * x.zz};
  sum.turn = sum.turn + w * term.turn;
}

}  // namespace

VertexSum vertex_sum(const Weigher& weigher, const Binding& binding, const Mask& mask, const Rows& rows,
                     std::size_t vertex) {
  VertexSum sum;
  // Stretches without logs, and moments, come without a rotation.
  sum.has_logs = rows.form == RowForm::logs;
  const auto visit = [&](std::size_t, const std::vector<double>& weights, double share) {
    if (mask) share *= static_cast<double>((*mask)[vertex]);
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (weights[j] != 0) sum.terms.push_back(term_of(rows, sum.has_logs, j, share * weights[j]));
  };
  const std::array<std::size_t, 1> one{vertex};
  if (entry(binding.weighting.weights).on_surface) {
    visit_kept_weights(binding, one,
                       [&](std::size_t i, const std::vector<double>& weights) { visit(i, weights, 1); });
  } else {
    visit_weights(weigher, std::array{binding.rest[vertex]}, visit);
  }
  if (!sum.has_logs)
    for (VertexSum::Term& term : sum.terms)
      term.at = weigher.origin() + weigher.handle_positions()[term.handle];
  std::ranges::stable_sort(sum.terms, [](const VertexSum::Term& a, const VertexSum::Term& b) {
    return std::abs(a.weight) > std::abs(b.weight);
  });
  for (const VertexSum::Term& term : sum.terms) add(term, sum);
  return sum;
}

namespace {

// All members but weights and offsets.
BoundPart unweighed_part(const Weigher& weigher, std::span<const mesh::Point> points) {
  BoundPart part;
  Binding& b = part.binding;
  b.weighting = weigher.weighting();
  b.vertices = points.size();
  b.handles = weigher.handles();
  b.rest.assign(points.begin(), points.end());
  b.rest_origin = weigher.origin();
  b.weights.reserve(b.vertices * b.handles);
  b.offsets.reserve(b.vertices);
  return part;
}

void add_row(const Weigher& weigher, const mesh::Point& point, std::span<const double> weights, Binding& b) {
  b.weights.insert(b.weights.end(), weights.begin(), weights.end());
  b.offsets.push_back(
      rest_offset(weigher.cage(), weigher.handle_positions(), point - weigher.origin(), weights));
}

}  // namespace

BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points) {
  BoundPart part = unweighed_part(weigher, points);
  const auto add = [&](std::size_t i, const std::vector<double>& weights, double share) {
    add_row(weigher, points[i], weights, part.binding);
    if (weigher.weighting().partial()) part.binding.shares.push_back(share);
  };
  part.failed = visit_weights(weigher, points, add);
  return part;
}

BoundPart sampled_part(const Weigher& weigher, const TiledBinding& tiles,
                       std::span<const mesh::Point> points) {
  BoundPart part = unweighed_part(weigher, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    add_row(weigher, points[i], std::span(tiles.sample).subspan(i * tiles.handles, tiles.handles),
            part.binding);
  return part;
}

namespace {

Mask at_vertices(const Mask& mask, std::span<const std::size_t> vertices) {
  if (!mask) return nullptr;
  std::vector<float> some;
  for (const auto v : vertices) some.push_back((*mask)[v]);
  return std::make_shared<const std::vector<float>>(std::move(some));
}

// Moves positions by probes at the places of the frame.
void move_by(const ProbeLayer& layer, std::span<const std::size_t> vertices, const Vec3& origin,
             std::span<mesh::Point> positions) {
  for (mesh::Point& p : positions) p = p - origin;
  layer.move(std::vector<std::uint32_t>(vertices.begin(), vertices.end()), positions, sym3::Method::fast);
  for (mesh::Point& p : positions) p = origin + p;
}

}  // namespace

double sampled_error(const Weigher& weigher, const Binding& binding, const Mask& mask,
                     std::span<const Vec3> ways, const Rows& rows, const ProbeLayer* layer,
                     std::span<const Vec3> shown) {
  const auto vertices = spread_vertices(binding.vertices, error_sample);
  std::vector<mesh::Point> exact;
  std::vector<Vec3> own;
  for (const auto v : vertices) {
    exact.push_back(binding.rest[v]);
    if (!ways.empty()) own.push_back(ways[v]);
  }
  BoundPart part = entry(binding.weighting.weights).on_surface ? sampled_part(weigher, *binding.tiles, exact)
                                                               : bind_part(weigher, exact);
  shape_by(part.binding, own);
  part.binding.shares = product(std::move(part.binding.shares), at_vertices(mask, vertices));
  place_vertices(part.binding, rows, sym3::Method::fast, exact);
  if (layer && layer->moves()) move_by(*layer, vertices, rows.origin, exact);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, norm(rows.origin + shown[i] - exact[i]));
  return worst / weigher.cage().diagonal;
}

std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 const Mask& mask, const Rows& rows, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 1024;
  std::vector<sym3::Sym3<double>> sample;
  if (rows.form != RowForm::logs) return sample;
  std::vector<mesh::Point> points;
  const auto vertices = spread_vertices(binding.vertices, limit);
  for (const auto v : vertices) points.push_back(binding.rest[v]);
  sample.reserve(points.size());
  const auto visit = [&](std::size_t s, const std::vector<double>& weights, double of_weights) {
    const double share = of_weights * (mask ? static_cast<double>((*mask)[vertices[s]]) : 1);
    if (progress && sample.size() % portion == 0) {
      progress->report(static_cast<double>(sample.size()) / static_cast<double>(points.size()));
    }
    sym3::Sym3<double> m{};
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double w = share * weights[j];
      const double* x = rows.values.data() + j * rows.columns();
      m = {m.xx + w * x[0], m.xy + w * x[1], m.xz + w * x[2],
           m.yy + w * x[3], m.yz + w * x[4], m.zz + w * x[5]};
    }
    sample.push_back(m);
  };
  if (entry(binding.weighting.weights).on_surface) {
    visit_kept_weights(binding, vertices,
                       [&](std::size_t s, const std::vector<double>& weights) { visit(s, weights, 1); });
  } else {
    visit_weights(weigher, points, visit);
  }
  return sample;
}

}  // namespace viete::deform
