#include "deform/vertex_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deform/maps.h"
#include "deform/point_weights.h"
#include "deform/scheme.h"
#include "deform/staged_engine.h"
#include "deform/tiled_binding.h"

namespace viete::deform {

VertexSum vertex_sum(const Weigher& weigher, const Binding& binding, const Mask& mask, const Rows& rows,
                     std::size_t vertex) {
  const Binding part = BoundVertices(weigher, binding, mask).part(std::array{vertex});
  const double share = part.shares.empty() ? 1 : part.shares[0];
  VertexSum sum;
  sum.has_logs = rows.form == RowForm::logs;
  for (std::uint32_t j = 0; j < part.handles; ++j) {
    if (part.weights[j] == 0) continue;
    auto& term = sum.terms.emplace_back(VertexSum::Term{j, share * part.weights[j]});
    term.at = weigher.origin() + weigher.handle_positions()[j];
    if (!sum.has_logs) continue;
    const double* x = rows.values.data() + j * log_shape.columns;
    term.stretch = {x[0], x[1], x[2], x[3], x[4], x[5]};
    term.turn = {x[6], x[7], x[8]};
    term.at = rows.origin + Vec3{x[9], x[10], x[11]};
  }
  std::ranges::stable_sort(sum.terms, [](const VertexSum::Term& a, const VertexSum::Term& b) {
    return std::abs(a.weight) > std::abs(b.weight);
  });
  for (const VertexSum::Term& term : sum.terms) {
    sum.stretch = plus(sum.stretch, term.weight, term.stretch);
    sum.turn = sum.turn + term.weight * term.turn;
  }
  return sum;
}

namespace {

// Returns a binding of the points with all members except weights and offsets.
Binding unweighed_part(const Weigher& weigher, std::span<const mesh::Point> points) {
  Binding b;
  b.weighting = weigher.weighting();
  b.vertices = points.size();
  b.handles = weigher.handles();
  b.rest = std::make_shared<const std::vector<mesh::Point>>(points.begin(), points.end());
  b.rest_origin = weigher.origin();
  b.weights.reserve(b.vertices * b.handles);
  b.offsets.reserve(b.vertices);
  return b;
}

void add_row(const Weigher& weigher, std::span<const double> weights, Binding& b) {
  b.weights.insert(b.weights.end(), weights.begin(), weights.end());
  b.offsets.push_back(rest_offset(weigher.cage(), weigher.handle_positions(),
                                  (*b.rest)[b.offsets.size()] - weigher.origin(), weights));
}

}  // namespace

BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points) {
  BoundPart part{unweighed_part(weigher, points)};
  std::vector<double> weights(weigher.scratch_size()), row(weigher.handles());
  for (std::size_t s = 0; s < points.size(); s += bind_lanes) {
    const std::size_t count = std::min(bind_lanes, points.size() - s);
    std::array<mesh::Point, bind_lanes> lanes;
    for (std::size_t l = 0; l < bind_lanes; ++l) lanes[l] = points[s + std::min(l, count - 1)];
    Weigher::LaneShares shares;
    const unsigned lost = weigher.weigh(lanes, weights, shares);
    for (std::size_t l = 0; l < count; ++l) {
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = weights[j * bind_lanes + l];
      add_row(weigher, row, part.binding);
      if (weigher.weighting().partial()) part.binding.shares.push_back(shares[l]);
      part.failed += lost >> l & 1;
    }
  }
  return part;
}

BoundVertices::BoundVertices(const Weigher& weigher, const Binding& binding, const Mask& mask)
    : weigher_(weigher), binding_(binding), mask_(mask) {
  if (entry(binding.weighting.weights).on_surface && binding.weights.empty())
    slots_ = slots_of(binding.tiles->leaves);
}

namespace {

// Binds points. Computes weights in space, but reads weights along the surface from row(i).
template <class Row>
Binding weighed_part(const Weigher& weigher, std::span<const mesh::Point> points, const Row& row) {
  if (!entry(weigher.weighting().weights).on_surface) return bind_part(weigher, points).binding;
  Binding part = unweighed_part(weigher, points);
  for (std::size_t i = 0; i < points.size(); ++i) add_row(weigher, row(i), part);
  return part;
}

}  // namespace

Binding BoundVertices::part(std::span<const std::size_t> vertices) const {
  std::vector<double> kept(weigher_.handles());
  const auto row = [&](std::size_t i) -> std::span<const double> {
    if (slots_.empty()) return std::span(binding_.weights).subspan(vertices[i] * kept.size(), kept.size());
    binding_.tiles->kept_row(slots_[vertices[i]], kept);
    return kept;
  };
  Binding part = weighed_part(weigher_, picked(std::span(*binding_.rest), vertices), row);
  part.shares = product(std::move(part.shares), picked(values(mask_), vertices));
  return part;
}

namespace {

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
  auto exact = picked(std::span(*binding.rest), vertices);
  const Binding part = weighed_part(weigher, exact, [&](std::size_t i) {
    return std::span(binding.tiles->sample).subspan(i * weigher.handles(), weigher.handles());
  });
  const Shares shares = product(part.shares, picked(values(mask), vertices));
  place_vertices({part, shares, picked(ways, vertices)}, rows, sym3::Method::fast, exact);
  if (layer && layer->moves()) move_by(*layer, vertices, rows.origin, exact);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, norm(rows.origin + shown[i] - exact[i]));
  return worst / weigher.cage().diagonal;
}

std::vector<sym3::Sym3<double>> sample_stretches(const Weigher& weigher, const Binding& binding,
                                                 const Mask& mask, const Rows& rows, std::size_t limit,
                                                 base::Progress* progress) {
  constexpr std::size_t portion = 256;
  if (rows.form != RowForm::logs) return {};
  const auto vertices = spread_vertices(binding.vertices, limit);
  const BoundVertices bound(weigher, binding, mask);
  std::vector<sym3::Sym3<double>> sample(vertices.size());
  for (std::size_t begin = 0; begin < vertices.size(); begin += portion) {
    if (progress) progress->report(static_cast<double>(begin) / static_cast<double>(vertices.size()));
    const auto some = std::span(vertices).subspan(begin, std::min(portion, vertices.size() - begin));
    const Binding part = bound.part(some);
    std::vector<double> sums(some.size() * log_shape.columns);
    blend({part, part.shares}, rows, 0, some.size(), sums);
    stretch_logs(sums, 0, some.size(), std::span(sample).subspan(begin));
  }
  return sample;
}

}  // namespace viete::deform
