#include "weights/bind.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>

#include "base/error.h"
#include "mesh/normals.h"
#include "pose/cage_state.h"
#include "weights/point_weights.h"
#include "weights/surface_proxy.h"
#include "weights/surface_weights.h"
#include "weights/tiled_binding.h"

namespace viete::weights {

namespace {

constexpr std::size_t rows_per_block = 64;

void allocate(Binding& binding) {
  const auto bytes = static_cast<double>(
      binding_bytes(binding.vertices, binding.handles, pose::EngineKind::staged, binding.weighting));
  const auto need = binding_memory(bytes, binding.vertices, binding.handles);
  base::require_memory(need);
  try {
    binding.weights.resize(binding.vertices * binding.handles);
    binding.offsets.resize(binding.vertices);
    if (binding.weighting.partial()) binding.shares.resize(binding.vertices);
  } catch (const std::exception&) {  // of a failed allocation
    base::refuse_memory(need);
  }
}

// Returns a binding without weights and offsets.
Binding unweighed(SharedShape rest, const pose::Cage& cage, const pose::Weighting& weighting) {
  Binding b;
  b.weighting = weighting;
  b.vertices = rest->size();
  b.handles = handle_count(cage, weighting.elements);
  b.rest = std::move(rest);
  b.rest_origin = pose::middle(cage.surface.positions);
  return b;
}

// Adds weights and shares. Returns the number of vertices without mean value coordinates.
std::size_t weigh(const Weigher& weigher, Binding& b) {
  std::vector<double> weights(weigher.scratch_size());
  std::size_t failed = 0;
  for (std::size_t s = 0; s < b.vertices; s += bind_lanes) {
    const std::size_t count = std::min(bind_lanes, b.vertices - s);
    std::array<mesh::Point, bind_lanes> points;
    for (std::size_t l = 0; l < bind_lanes; ++l) points[l] = (*b.rest)[s + std::min(l, count - 1)];
    Weigher::LaneShares shares;
    const unsigned lost = weigher.weigh(points, weights, shares);
    for (std::size_t l = 0; l < count; ++l) {
      for (std::size_t j = 0; j < b.handles; ++j) b.weights.push_back(weights[j * bind_lanes + l]);
      if (b.weighting.partial()) b.shares.push_back(shares[l]);
      failed += lost >> l & 1;
    }
  }
  return failed;
}

void solve_surface_weights(const mesh::Surface& model, const pose::Cage& cage, Binding& b,
                           base::WorkerPool& pool, base::Progress* progress) {
  if (b.vertices > most_solved_vertices) {
    constexpr double solved = 0.7;  // progress with the proxy's weights
    const ProxyWeights proxy = [&] {
      const base::ProgressPart part(progress, 0, solved);
      return ProxyWeights(model, cage, b.weighting, pool, progress);
    }();
    std::atomic<std::size_t> done{0};
    return pool.for_blocks(b.vertices, rows_per_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        proxy.row(static_cast<std::uint32_t>(v), std::span(b.weights).subspan(v * b.handles, b.handles));
      const auto count = static_cast<double>(done += end - begin);
      if (progress) progress->report(std::lerp(solved, 1.0, count / static_cast<double>(b.vertices)));
    });
  }
  const SurfaceSystem system(model, cage, b.weighting, pool, progress);
  const auto store = [&](const SurfaceSystem::Solved& solved) {
    for (std::size_t v = 0; v < b.vertices; ++v)
      std::copy_n(solved.of(v), solved.count, b.weights.data() + v * b.handles + solved.first);
  };
  system.solve(store, pool, progress);
}

// Sets weights, shares and offsets. Weights along the surface are already solved; with a proxy, their sum
// is 1. Returns the number of vertices without mean value coordinates.
std::size_t fill(const pose::Cage& cage, Binding& b, base::WorkerPool& pool, base::Progress* progress) {
  const Weigher weigher(cage, b.weighting);
  const bool on_surface = b.weighting.on_surface();
  std::atomic<std::size_t> done{0}, failed{0};
  pool.for_blocks(b.vertices, rows_per_block, [&](std::size_t begin, std::size_t end) {
    const auto rows = b.weights.begin() + std::ptrdiff_t(begin * b.handles);
    std::vector<double> solved;
    if (on_surface) solved.assign(rows, rows + std::ptrdiff_t((end - begin) * b.handles));
    for (std::size_t i = 0; i < solved.size() && b.vertices <= most_solved_vertices; i += b.handles)
      normalise(std::span(solved).subspan(i, b.handles), b.weighting.clamped());
    const auto part = bind_part(weigher, std::span(*b.rest).subspan(begin, end - begin), std::move(solved));
    std::ranges::copy(part.binding.weights, rows);
    std::ranges::copy(part.binding.offsets, b.offsets.begin() + std::ptrdiff_t(begin));
    if (!b.shares.empty()) std::ranges::copy(part.binding.shares, b.shares.begin() + std::ptrdiff_t(begin));
    failed += part.failed;
    done += end - begin;
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(b.vertices));
  });
  return failed;
}

}  // namespace

BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points,
                    std::vector<double> weights) {
  BoundPart part{unweighed(std::make_shared<std::vector<mesh::Point>>(points.begin(), points.end()),
                           weigher.cage(), weigher.weighting())};
  Binding& b = part.binding;
  b.weights = std::move(weights);
  if (b.weights.empty()) part.failed = weigh(weigher, b);
  for (std::size_t i = 0; i < points.size(); ++i)
    b.offsets.push_back(rest_offset(weigher.cage(), weigher.handle_positions(), points[i] - weigher.origin(),
                                    std::span(b.weights).subspan(i * b.handles, b.handles)));
  return part;
}

KnownRow known_row(const Binding& binding) {
  if (!binding.weighting.smooth()) return {};
  if (binding.weights.empty())
    return [&tiles = *binding.tiles, slots = slots_of(binding.tiles->leaves)](
               std::uint32_t vertex, std::span<double> row) { tiles.kept_row(slots[vertex], row); };
  return [&binding](std::uint32_t vertex, std::span<double> row) {
    std::copy_n(binding.weights.data() + vertex * row.size(), row.size(), row.begin());
  };
}

BoundPart bind_vertices(const Weigher& weigher, std::span<const mesh::Point> rest, const KnownRow& row,
                        const Mask& mask, std::span<const std::size_t> vertices) {
  const std::size_t k = weigher.handles();
  std::vector<double> weights(row ? vertices.size() * k : 0);
  for (std::size_t i = 0; i * k < weights.size(); ++i)
    row(static_cast<std::uint32_t>(vertices[i]), std::span(weights).subspan(i * k, k));
  BoundPart part = bind_part(weigher, picked(rest, vertices), std::move(weights));
  part.binding.shares = product(std::move(part.binding.shares), picked(values(mask), vertices));
  return part;
}

Binding bind(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
             base::WorkerPool& pool, base::Progress* progress) {
  return weights::bind(std::make_shared<const mesh::Surface>(model), cage, weighting,
                       pose::EngineKind::staged, nullptr, pool, progress);
}

Binding bind(std::shared_ptr<const mesh::Surface> model, const pose::Cage& cage, const pose::Weighting& asked,
             pose::EngineKind engine, const Binding* known, base::WorkerPool& pool,
             base::Progress* progress) {
  const pose::Weighting weighting = weighting_for(*model, asked);
  if (model->positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  if (weighting.weights == pose::Weights::mean_value && cage.sides.triangles.empty())
    throw base::Error("", "mean value coordinates need a cage with consistently oriented faces",
                      "flip or remove the faces that disagree, or use other weights");
  auto tiles = known ? known->tiles : nullptr;
  if (engine != pose::EngineKind::staged) {
    if (!tiles)
      tiles = std::make_shared<const TiledBinding>(
          bind_tiles(*model, cage, weighting, pool, usual_tolerance, progress));
    return with_tiles(std::move(model), cage, std::move(tiles));
  }
  Binding binding = unweighed({model, &model->positions}, cage, weighting);
  binding.tiles = std::move(tiles);
  allocate(binding);
  binding.around = mesh::vertex_triangles(binding.vertices, model->triangles);
  const bool on_surface = weighting.on_surface();
  if (on_surface) solve_surface_weights(*model, cage, binding, pool, progress);
  const std::size_t failed = fill(cage, binding, pool, on_surface ? nullptr : progress);
  binding.model = std::move(model);
  drop_whole(binding.shares);
  binding.warnings = weight_warnings(cage, weighting.weights, failed, binding.vertices);
  return binding;
}

Binding with_tiles(std::shared_ptr<const mesh::Surface> model, const pose::Cage& cage,
                   std::shared_ptr<const TiledBinding> tiles) {
  Binding binding = unweighed({model, &model->positions}, cage, tiles->weighting);
  binding.warnings = weight_warnings(cage, binding.weighting.weights, tiles->failed, binding.vertices);
  binding.tiles = std::move(tiles);
  return binding;
}

}  // namespace viete::weights
