#include "deform/bind.h"

#include <atomic>
#include <cmath>
#include <new>
#include <stdexcept>

#include "base/error.h"
#include "deform/cage_state.h"
#include "deform/maps.h"
#include "deform/point_weights.h"
#include "deform/surface_proxy.h"
#include "deform/surface_weights.h"
#include "deform/tiled_binding.h"
#include "mesh/normals.h"

namespace viete::deform {

namespace {

constexpr std::size_t rows_per_block = 64;

void allocate(Binding& binding) {
  const auto bytes = static_cast<double>(
      binding_bytes(binding.vertices, binding.handles, EngineKind::staged, binding.weighting));
  const auto need = binding_memory(bytes, binding.vertices, binding.handles);
  base::require_memory(need);
  try {
    binding.weights.resize(binding.vertices * binding.handles);
    binding.offsets.resize(binding.vertices);
    if (binding.weighting.partial()) binding.shares.resize(binding.vertices);
  } catch (const std::bad_alloc&) {
    base::refuse_memory(need);
  } catch (const std::length_error&) {
    base::refuse_memory(need);
  }
}

// Writes weights, shares and offsets of the vertices [begin, end) to `b`. Returns the number of vertices
// without mean value coordinates. `handles` are the handles' rest centres relative to `origin`.
std::size_t fill_rows(const Cage& cage, std::span<const Vec3> handles, const Vec3& origin, std::size_t begin,
                      std::size_t end, Binding& b) {
  std::size_t failed = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::span<double> row(b.weights.data() + i * b.handles, b.handles);
    switch (b.weighting.weights) {
      case Weights::inverse: inverse_distance_weights(cage, (*b.rest)[i], row, b.weighting.elements); break;
      case Weights::cut_off:
        b.shares[i] = share_of_motion(cut_off_weights(cage, (*b.rest)[i], b.weighting, row));
        break;
      case Weights::mean_value: failed += !mean_value_weights(cage, (*b.rest)[i], row); break;
      case Weights::harmonic:
      case Weights::biharmonic:  // `row` is already solved; with a proxy, its sum is 1
        if (b.vertices <= most_solved_vertices) normalise(row, b.weighting.clamped());
        break;
    }
    b.offsets[i] = rest_offset(cage, handles, (*b.rest)[i] - origin, row);
  }
  return failed;
}

void solve_surface_weights(const mesh::Surface& model, const Cage& cage, Binding& b, base::WorkerPool& pool,
                           base::Progress* progress) {
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

std::size_t fill(const Cage& cage, Binding& binding, base::WorkerPool& pool, base::Progress* progress) {
  std::atomic<std::size_t> done{0}, failed{0};
  const auto centers = handle_centers(cage, binding.weighting.elements);
  const Vec3 origin = binding.rest_origin;
  const auto handles = relative_to(origin, {centers.begin(), centers.end()});
  pool.for_blocks(binding.vertices, rows_per_block, [&](std::size_t begin, std::size_t end) {
    failed += fill_rows(cage, handles, origin, begin, end, binding);
    done += end - begin;
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(binding.vertices));
  });
  return failed;
}

Binding unweighed(const std::shared_ptr<const mesh::Surface>& model, const Cage& cage,
                  const Weighting& weighting) {
  Binding binding;
  binding.weighting = weighting;
  binding.vertices = model->positions.size();
  binding.handles = handle_count(cage, weighting.elements);
  binding.rest = {model, &model->positions};
  binding.rest_origin = middle(cage.surface.positions);
  return binding;
}

}  // namespace

Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress) {
  return deform::bind(std::make_shared<const mesh::Surface>(model), cage, weighting, EngineKind::staged,
                      nullptr, pool, progress);
}

Binding bind(std::shared_ptr<const mesh::Surface> model, const Cage& cage, const Weighting& weighting,
             EngineKind engine, const Binding* known, base::WorkerPool& pool, base::Progress* progress) {
  if (model->positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  if (weighting.weights == Weights::mean_value && cage.sides.triangles.empty())
    throw base::Error("", "mean value coordinates need a cage with consistently oriented faces",
                      "flip or remove the faces that disagree, or use other weights");
  auto tiles = known ? known->tiles : nullptr;
  if (engine != EngineKind::staged) {
    if (!tiles)
      tiles = std::make_shared<const TiledBinding>(
          bind_tiles(*model, cage, weighting, pool, usual_tolerance, progress));
    return with_tiles(std::move(model), cage, std::move(tiles));
  }
  Binding binding = unweighed(model, cage, weighting);
  binding.tiles = std::move(tiles);
  allocate(binding);
  binding.around = mesh::vertex_triangles(binding.vertices, model->triangles);
  const bool on_surface = entry(weighting.weights).on_surface;
  if (on_surface) solve_surface_weights(*model, cage, binding, pool, progress);
  const std::size_t failed = fill(cage, binding, pool, on_surface ? nullptr : progress);
  binding.model = std::move(model);
  drop_whole(binding.shares);
  binding.warnings = weight_warnings(cage, weighting.weights, failed, binding.vertices);
  return binding;
}

Binding with_tiles(std::shared_ptr<const mesh::Surface> model, const Cage& cage,
                   std::shared_ptr<const TiledBinding> tiles) {
  Binding binding = unweighed(model, cage, tiles->weighting);
  binding.warnings = weight_warnings(cage, binding.weighting.weights, tiles->failed, binding.vertices);
  binding.tiles = std::move(tiles);
  return binding;
}

}  // namespace viete::deform
