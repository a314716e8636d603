#include "deform/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "deform/apply.h"
#include "deform/blend.h"
#include "deform/map_rows.h"
#include "deform/moments.h"
#include "deform/probe_layer.h"
#include "deform/stitcher.h"
#include "deform/vertex_sample.h"
#include "deform/weigher.h"

namespace viete::deform {

namespace {

using Stretch = sym3::Sym3<double>;

// As many vertices as have a megabyte of weights, within limits.
std::size_t weighed_at_once(std::size_t handles) {
  constexpr std::size_t weights = 1 << 17, most = 4096;
  return std::clamp(weights / std::max<std::size_t>(handles, 1) / bind_lanes * bind_lanes, bind_lanes, most);
}

double squared_frobenius(const Stretch& m) {
  return m.xx * m.xx + m.yy * m.yy + m.zz * m.zz + 2 * (m.xy * m.xy + m.xz * m.xz + m.yz * m.yz);
}

double relative_difference(const Stretch& a, const Stretch& b) {
  const Stretch d{a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
  const double difference = std::sqrt(squared_frobenius(d) / squared_frobenius(b));
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double worst_difference(std::span<const Stretch> computed, std::span<const Stretch> logs) {
  std::vector<Stretch> exact(logs.size());
  sym3::exp<double>(logs, exact);
  double worst = 0;
  for (std::size_t i = 0; i < logs.size(); ++i)
    worst = std::max(worst, relative_difference(computed[i], exact[i]));
  return worst;
}

double place_logs(const Binding& binding, const Rows& rows, sym3::Method method,
                  std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  BlendedLogs sums;
  sums.resize(n);
  blend(binding, rows, 0, n, sums);
  share_sums(binding, binding.shares, 0, n, sums);
  std::vector<Stretch> stretches(n);
  sym3::exp<double>(sums.stretch, stretches, method);
  apply(binding, binding.shares, sums, stretches, rows.origin, 0, n, positions);
  return method == sym3::Method::fast ? 0 : worst_difference(stretches, sums.stretch);
}

double place_others(const Binding& binding, const Rows& rows, sym3::Method method,
                    std::span<mesh::Point> positions) {
  const std::size_t n = positions.size();
  if (has_moments(rows.form)) {
    place_by_moments(binding, binding.shares, rows, 0, n, positions);
    return 0;
  }
  std::vector<double> sums(n * rows.columns());
  blend(binding, rows, 0, n, std::span(sums));
  share_sums(binding, binding.shares, rows.form, 0, n, sums);
  std::vector<Stretch> logs, stretches;
  if (has_stretch_logs(rows.form)) {
    logs.resize(n), stretches.resize(n);
    exponentiate(rows.form, sums, method, 0, n, logs, stretches);
  }
  apply(binding, binding.shares, rows.form, sums, stretches, rows.origin, 0, n, positions);
  return method == sym3::Method::fast ? 0 : worst_difference(stretches, logs);
}

// Of the vertices [begin, end), without their triangles.
Binding part_of(const Binding& whole, std::size_t begin, std::size_t end) {
  const auto rows = [&](const auto& values, std::size_t length) {
    const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i * length); };
    return std::remove_cvref_t<decltype(values)>(at(begin), at(end));
  };
  Binding part;
  part.weighting = whole.weighting;
  part.vertices = end - begin;
  part.handles = whole.handles;
  part.rest_origin = whole.rest_origin;
  part.rest = rows(whole.rest, 1);
  part.weights = rows(whole.weights, whole.handles);
  part.offsets = rows(whole.offsets, 1);
  return part;
}

Mask part_of(const Mask& whole, std::size_t begin, std::size_t end) {
  if (!whole) return nullptr;
  const auto first = whole->begin();
  return std::make_shared<const std::vector<float>>(first + std::ptrdiff_t(begin),
                                                    first + std::ptrdiff_t(end));
}

}  // namespace

double place_vertices(const Binding& binding, const Rows& rows, sym3::Method method,
                      std::span<mesh::Point> positions) {
  return rows.form == RowForm::logs ? place_logs(binding, rows, method, positions)
                                    : place_others(binding, rows, method, positions);
}

namespace {

// What stitching takes of a pose: sums of rows at every vertex. Positions become those that are stitched.
void stitch_positions(const Stitching& stitching, const Rows& rows, std::span<const double> sums,
                      const Shares& shares, const Scheme& scheme, sym3::Method method, base::WorkerPool& pool,
                      std::span<mesh::Point> positions) {
  std::vector<Vec3> held;
  for (const auto& hold : stitching.holds) held.push_back(positions[hold.vertex] - rows.origin);
  Stitcher stitcher(stitching, rows.form, pool);
  stitcher.set_shares(shares);
  stitcher.run(rows, sums, held, method, scheme.iterations);
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = rows.origin + stitcher.positions()[v];
}

}  // namespace

ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const Cage> cage, const Scheme& scheme,
                          const Pose& pose, sym3::Method method, base::WorkerPool& pool,
                          base::Progress* progress, const Mask& mask, const Probes& probes) {
  const std::span<const mesh::Point> rest = model.positions;
  if (rest.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  CageState state(cage, scheme.weighting.elements, scheme.blend);
  state.set_amounts(scheme.amounts);
  state.keep_origin(mask || scheme.weighting.partial());
  state.set_pose(pose);
  const Rows rows = state.rows();
  std::optional<Stitching> stitching;
  if (scheme.stitched())
    stitching = stitch(model, *cage, scheme.weighting.elements, pool, settings_of(scheme.holding));
  const Weigher weigher(*cage, scheme.weighting);
  Binding whole;
  const bool on_surface = entry(scheme.weighting.weights).on_surface;
  if (on_surface) whole = bind(model, *cage, scheme.weighting, pool, progress);
  ExactModel exact;
  exact.report = state.report();
  exact.positions.resize(rest.size());
  std::vector<double> sums(stitching ? rest.size() * rows.columns() : 0);
  Shares shares(stitching && (mask || scheme.weighting.partial()) ? rest.size() : 0);
  std::size_t done = 0, failed = 0;
  std::mutex mutex;  // of these, and of exp_error
  const auto take = [&](std::size_t count, std::size_t lost, double error) {
    const std::lock_guard lock(mutex);
    done += count;
    failed += lost;
    exact.exp_error = std::max(exact.exp_error, error);
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(rest.size()));
  };
  pool.for_blocks(rest.size(), weighed_at_once(weigher.handles()), [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    BoundPart part =
        on_surface ? BoundPart{part_of(whole, begin, end)} : bind_part(weigher, rest.subspan(begin, count));
    part.binding.shares = product(std::move(part.binding.shares), part_of(mask, begin, end));
    if (!shares.empty()) std::ranges::copy(part.binding.shares, shares.begin() + std::ptrdiff_t(begin));
    const auto positions = std::span(exact.positions).subspan(begin, count);
    take(count, part.failed, place_vertices(part.binding, rows, method, positions));
    const std::size_t columns = rows.columns();
    if (!stitching) return;
    const auto part_sums = std::span(sums).subspan(begin * columns, count * columns);
    blend(part.binding, rows, 0, count, part_sums);
    share_sums(part.binding, part.binding.shares, rows.form, 0, count, part_sums);
  });
  if (stitching) stitch_positions(*stitching, rows, sums, shares, scheme, method, pool, exact.positions);
  ProbeLayer layer(rest, pool);
  layer.set(probes, mask);
  if (layer.moves()) layer.move_all(exact.positions, method);
  exact.warnings = weight_warnings(*cage, scheme.weighting.weights, failed, rest.size());
  return exact;
}

}  // namespace viete::deform
