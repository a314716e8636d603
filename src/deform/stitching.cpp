#include "deform/stitching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "base/error.h"
#include "deform/staged_engine.h"
#include "mesh/point_index.h"
#include "mesh/triangle.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"
#include "pose/maps.h"
#include "weights/bind.h"
#include "weights/laplacian.h"
#include "weights/leaves.h"
#include "weights/part_coupling.h"
#include "weights/point_weights.h"

namespace viete::deform {

namespace {

constexpr auto no_triangle = std::numeric_limits<std::uint32_t>::max();
constexpr double found_pins = 0.5;  // the fraction of the work that is done when the pins are known
constexpr double hold_of_loose_vertex = 1;
constexpr double hold_of_loose_part = 1e-4;
constexpr std::size_t gradients_per_block = 128;
constexpr double indistinguishable = 1e-9;  // in cage diagonals; smaller differences of distances count as 0

class StitchMaker {
public:
  StitchMaker(const mesh::Surface& model, const pose::Cage& cage, const pose::Holding& holding,
              base::WorkerPool& pool, base::Progress* progress)
      : original_(model),
        split_(mesh::split_unsettled(model, weights::most_split_corners)),
        cage_(cage),
        holding_(holding),
        pool_(pool),
        progress_(progress) {}

  Stitching make() {
    find_thin();
    find_couplings();
    find_pins();
    hold_the_rest();
    sparse::SparseMatrix matrix =
        with_couplings(weights::stiffness_matrix(model_.positions, model_.triangles), couplings_);
    add_diagonal(matrix);
    Stitching s{holding_,
                rings(),
                {},
                {},
                {},
                {},
                std::move(couplings_),
                {},
                {},
                std::move(pins_),
                {},
                std::move(holds_),
                sparse::SparseCholesky(matrix, pool_, sparse::told(progress_, found_pins, 1))};
    fill_triangles(s);
    fill_pinned(s);
    return s;
  }

private:
  mesh::Adjacency rings() const {
    mesh::Adjacency rings{{0}, {}};
    for (const auto polygon : split_.polygons) {
      const auto ring = original_.polygon(polygon);
      rings.items.insert(rings.items.end(), ring.begin(), ring.end());
      rings.starts.push_back(static_cast<std::uint32_t>(rings.items.size()));
    }
    return rings;
  }

  void find_thin() {
    const auto& p = model_.positions;
    thin_.resize(model_.triangles.size());
    for (std::size_t t = 0; t < thin_.size(); ++t) {
      const auto& [a, b, c] = model_.triangles[t];
      thin_[t] = weights::is_thin(p[a], p[b], p[c]);
    }
  }

  void find_couplings() {
    couplings_ = weights::surface_couplings(original_, pool_);
    const auto lowest = mesh::lowest_in_place(original_.positions);
    for (std::uint32_t v = 0; v < lowest.size(); ++v) {
      const auto w = lowest[v];
      if (w != v) couplings_.push_back({v, {w, w, w}, {1, 0, 0}, weights::most_strength});
    }
  }

  void find_pins() {
    const auto& centers = cage_.centers;
    std::vector<std::vector<Stitching::Pin>> found(centers.size());
    pool_.for_blocks(centers.size(), 1, [&](std::size_t h, std::size_t) {
      if (progress_)
        progress_->report(found_pins * static_cast<double>(h) / static_cast<double>(centers.size()));
      if (!cage_.degenerate[h]) found[h] = pins_of(static_cast<std::uint32_t>(h), centers[h]);
    });
    for (const auto& pins : found) pins_.insert(pins_.end(), pins.begin(), pins.end());
  }

  // Returns the nearest triangles that are not thin. If triangles are equally near up to rounding, returns
  // those of them with the nearest centre.
  std::vector<std::size_t> nearest_triangles(const mesh::Point& point) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto& p = model_.positions;
    const double slack = indistinguishable * cage_.diagonal;
    double least = infinity, nearest_center = infinity;
    std::vector<std::pair<double, std::size_t>> near;  // distances of centres, and triangles
    for (const bool finds_distance : {true, false})
      for (std::size_t t = 0; t < model_.triangles.size(); ++t) {
        if (thin_[t]) continue;
        const auto& [a, b, c] = model_.triangles[t];
        const double side = std::sqrt(std::max(squared_norm(p[b] - p[a]), squared_norm(p[c] - p[a])));
        const double farthest = least + slack + side;  // limit of the distance to corner a
        if (squared_norm(point - p[a]) > farthest * farthest) continue;
        const double distance =
            std::sqrt(mesh::closest_on_triangle(point, p[a], p[b], p[c]).squared_distance);
        if (finds_distance) {
          least = std::min(least, distance);
        } else if (distance <= least + slack) {
          near.push_back({norm(point - (1.0 / 3) * (p[a] + p[b] + p[c])), t});
          nearest_center = std::min(nearest_center, near.back().first);
        }
      }
    std::vector<std::size_t> nearest;
    for (const auto& [center, t] : near)
      if (center <= nearest_center + slack) nearest.push_back(t);
    return nearest;
  }

  std::vector<Stitching::Pin> pins_of(std::uint32_t handle, const mesh::Point& center) const {
    std::vector<Stitching::Pin> pins;
    const double strength = pin_strength * weights::handle_shape(cage_, pose::Elements::face, handle).share;
    const auto triangles = nearest_triangles(center);
    for (const std::size_t t : triangles)
      for (const auto v : model_.triangles[t])
        pins.push_back({v, handle, strength / static_cast<double>(triangles.size())});
    const double radius = holding_.radius * cage_.size;
    for (std::uint32_t v = 0; radius > 0 && v < model_.positions.size(); ++v) {
      const double d = norm(model_.positions[v] - center);
      if (d < radius) pins.push_back({v, handle, strength * std::pow((radius - d) / radius, 2)});
    }
    return pins;
  }

  void hold_the_rest() {
    const std::size_t n = model_.positions.size();
    mesh::UnionFind parts(n);
    std::vector<std::uint8_t> firm(n, 0), pinned(n, 0);  // firm: one per vertex; pinned: one per part
    for (std::size_t t = 0; t < thin_.size(); ++t) {
      if (thin_[t]) continue;
      const auto& [a, b, c] = model_.triangles[t];
      parts.join(a, b);
      parts.join(b, c);
      firm[a] = firm[b] = firm[c] = 1;
    }
    for (const auto& c : couplings_) {
      for_sides(c, [&](const mesh::Triangle& t, double, double) {
        parts.join(t[0], t[1]);
        firm[t[0]] = firm[t[1]] = std::max(firm[t[0]], firm[t[1]]);
      });
    }
    for (const auto& pin : pins_) pinned[parts.find(pin.vertex)] = 1;
    for (std::uint32_t v = 0; v < original_.positions.size(); ++v) {
      double weight = holding_.weight;
      if (!firm[v]) {
        weight += hold_of_loose_vertex;
      } else if (!pinned[parts.find(v)]) {
        weight += hold_of_loose_part;
      }
      if (weight > 0) holds_.push_back({v, weight});
    }
  }

  void add_diagonal(sparse::SparseMatrix& matrix) const {
    std::vector<double> firmness(matrix.size(), 0.0);
    for (const auto& pin : pins_) firmness[pin.vertex] += pin.weight;
    for (const auto& hold : holds_) firmness[hold.vertex] += hold.weight;
    for (std::size_t v = 0; v < matrix.size(); ++v)
      for (auto i = matrix.starts[v]; i < matrix.starts[v + 1]; ++i) {
        if (static_cast<std::size_t>(matrix.rows[i]) == v) matrix.values[i] += firmness[v];
      }
  }

  void fill_triangles(Stitching& s) const {
    const auto& p = model_.positions;
    weights::Leaves leaves = weights::make_leaves(p, std::vector<std::uint32_t>(p.size(), 0));
    const std::vector<std::uint32_t> places = slots_of(leaves);
    s.order = std::move(leaves.order);
    s.order.resize(p.size());  // removes the padding
    s.triangles = mesh::proper_triangles(model_);
    const auto first_place = [&](const mesh::Triangle& t) {
      return std::min({places[t[0]], places[t[1]], places[t[2]]});
    };
    std::ranges::stable_sort(s.triangles, {}, first_place);
    for (const auto& [a, b, c] : s.triangles)
      s.cotangents.push_back(weights::half_cotangents(p[a], p[b], p[c]));
    std::vector<std::uint32_t> beside(p.size(), no_triangle);
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
      s.rotated_as.push_back(t);
      const auto& [a, b, c] = s.triangles[t];
      if (!weights::is_thin(p[a], p[b], p[c])) beside[a] = beside[b] = beside[c] = t;
    }
    for (const weights::Coupling& coupling : s.couplings) {
      for_sides(coupling, [&](const mesh::Triangle& t, double, double) {
        const auto own = static_cast<std::uint32_t>(s.triangles.size());
        const auto other = beside[t[0]] != no_triangle ? beside[t[0]] : beside[t[1]];
        s.rotated_as.push_back(other != no_triangle ? other : own);
        s.triangles.push_back(t);
      });
    }
    s.gradients = s.gradients_of(p, pool_);
    s.around = mesh::make_adjacency(p.size(), [&](const auto& add) {
      for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) add(places[s.triangles[t][k]], 3 * t + k);
      }
    });
  }

  void fill_pinned(Stitching& s) const {
    const auto& centers = cage_.centers;
    weights::Binding& b = s.pinned;
    b.vertices = s.pins.size();
    b.rest_origin = pose::middle(cage_.surface.positions);
    std::vector<mesh::Point> rest;
    for (const auto& pin : s.pins) {
      rest.push_back(model_.positions[pin.vertex]);
      b.offsets.push_back(rest.back() - centers[pin.handle]);
    }
    b.rest = std::make_shared<const std::vector<mesh::Point>>(std::move(rest));
  }

  const mesh::Surface& original_;
  const mesh::CenterSplit split_;
  const mesh::Surface& model_ = split_.surface;
  const pose::Cage& cage_;
  pose::Holding holding_;
  base::WorkerPool& pool_;
  base::Progress* progress_;
  std::vector<std::uint8_t> thin_;
  std::vector<weights::Coupling> couplings_;
  std::vector<Stitching::Pin> pins_;
  std::vector<Stitching::Hold> holds_;
};

Stitching stitch_all(const mesh::Surface& model, const pose::Cage& cage, base::WorkerPool& pool,
                     const pose::Holding& holding, base::Progress* progress) {
  const auto n = static_cast<double>(model.positions.size());
  // The terms are factors (n log n), data of two triangles per vertex, lists, and right-hand sides.
  const base::MemoryNeed need{n * (12 * 2.2 * std::log2(n + 2) + 2 * (12 + 24 + 48 + 72 + 48) + 28 + 80),
                              "stitching " + std::to_string(model.positions.size()) + " vertices takes",
                              "use a coarser model, or turn stitching off", ""};
  base::require_memory(need);
  try {
    return StitchMaker(model, cage, holding, pool, progress).make();
  } catch (const std::bad_alloc&) {
    base::refuse_memory(need);
  }
}

}  // namespace

// The gradients of a triangle are the first two rows of K * X. K is its stiffness matrix, which has the half
// cotangents h; the rows of X are a, b and c.
std::vector<std::array<Vec3, 2>> Stitching::gradients_of(std::span<const Vec3> x,
                                                         base::WorkerPool& pool) const {
  std::vector<std::array<Vec3, 2>> all(triangles.size());
  pool.for_blocks(cotangents.size(), gradients_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3 &h = cotangents[t], &a = x[triangles[t][0]], &b = x[triangles[t][1]],
                 &c = x[triangles[t][2]];
      all[t] = {h[2] * (a - b) + h[1] * (a - c), h[2] * (b - a) + h[0] * (b - c)};
    }
  });
  std::size_t next = cotangents.size();
  for (const weights::Coupling& coupling : couplings) {
    Vec3 gap = x[coupling.vertex];
    for (std::size_t k = 0; k < 3; ++k) gap = gap - coupling.shares[k] * x[coupling.triangle[k]];
    for_sides(coupling, [&](const mesh::Triangle&, double first, double second) {
      all[next++] = {first * gap, second * gap};
    });
  }
  return all;
}

Stitching stitch(const mesh::Surface& model, const pose::Cage& cage, base::WorkerPool& pool,
                 const pose::Deformer& deformer, base::Progress* progress) {
  if (model.positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  if (!weights::stitches_coarse_model(model))
    return stitch_all(model, cage, pool, deformer.holding, progress);
  std::optional<base::ProgressPart> part(std::in_place, progress, 0, 0.5);
  const auto coarse =
      std::make_shared<const weights::CoarseModel>(weights::coarse_model_of(model, cage, pool, progress));
  part.emplace(progress, 0.5, 0.75);
  Stitching stitching = stitch_all(coarse->surface(), cage, pool, deformer.holding, progress);
  part.emplace(progress, 0.75, 1);
  stitching.bound = std::make_shared<const weights::Binding>(
      weights::bind({coarse, &coarse->surface()}, cage, weights::weighting_for(model, deformer.weighting),
                    pose::EngineKind::fused, nullptr, pool, progress));
  stitching.coarse = coarse;
  return stitching;
}

}  // namespace viete::deform
