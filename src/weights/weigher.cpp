#include "weights/weigher.h"

#include <algorithm>

#include "base/memory.h"
#include "mesh/half_edges.h"
#include "mesh/triangle.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "weights/bind_kernel.h"
#include "weights/point_weights.h"

namespace viete::weights {

namespace {

// Returns the numbers of a vector of arrays as the C arrays that kernels use.
template <class Arrays>
auto numbers(const Arrays& arrays) {
  using Array = typename Arrays::value_type;
  using Number = typename Array::value_type;
  return reinterpret_cast<const Number(*)[sizeof(Array) / sizeof(Number)]>(arrays.data());
}

bool touches(const pose::Cage& cage, std::span<const std::uint32_t> elements, const mesh::Point& p) {
  const auto& x = cage.elements.positions;
  return std::any_of(elements.begin(), elements.end(), [&](std::uint32_t e) {
    const auto& t = cage.elements.triangles[e];
    return mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance <=
           cage.contact * cage.contact;
  });
}

}  // namespace

pose::Weighting weighting_for(const mesh::Surface& model, pose::Weighting weighting) {
  weighting.in_space |= model.triangles.empty();
  return weighting;
}

Weigher::Weigher(const pose::Cage& cage, const pose::Weighting& weighting, const sym3::Kernel& kernel)
    : cage_(cage),
      weighting_(weighting),
      kernel_(bind_kernel(kernel)),
      origin_(pose::middle(cage.surface.positions)),
      scale_(std::exp2(-std::round(std::log2(cage.diagonal)))) {
  const auto centers = handle_centers(cage, weighting.elements);
  handles_ = relative_to(origin_, {centers.begin(), centers.end()});
  for (const Vec3& p : cage.elements.positions) corners_.push_back(scaled(p));
  if (weighting.smooth()) return;  // for those in space, see space()
  weighting.weights == pose::Weights::mean_value ? add_views() : add_triangles();
}

Vec3 Weigher::scaled(const mesh::Point& p) const {
  return scale_ * (p - origin_);
}

const SpaceWeights& Weigher::space() const {
  std::call_once(solved_, [this] {
    std::vector<Vec3> centers;
    for (const Vec3& handle : handles_) centers.push_back(scale_ * handle);
    space_.emplace(cage_, weighting_, std::move(centers), scale_);
  });
  return *space_;
}

void Weigher::add_triangles() {
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    const auto [t, share] = handle_shape(cage_, weighting_.elements, h);
    Vec3 origin;
    auto triangle = distance_triangle({corners_[t[0]], corners_[t[1]], corners_[t[2]]}, origin);
    triangle.share = share;
    triangles_.push_back(triangle);
    float_triangles_.push_back(in_float(triangle));
    origins_.push_back(origin);
    shifts_.push_back(shift_of(triangle, origin));
  }
}

// Skips elements without area: their two sides cancel. weigh_mean_values() handles points on such elements.
void Weigher::add_views() {
  for (std::size_t i = 0; i < cage_.sides.of.size(); ++i) {
    const auto& t = cage_.sides.triangles[i];
    if (const auto e = cage_.sides.of[i]; cage_.degenerate[e]) {
      without_area_.push_back(e);
    } else {
      views_.push_back({{t[0], t[1], t[2]}, {}, {}});
    }
  }
  std::vector<mesh::Triangle> triangles;
  for (const auto& view : views_) triangles.push_back({view.corner[0], view.corner[1], view.corner[2]});
  const auto table = mesh::half_edges(corners_.size(), triangles);
  // Edges are sorted by their first use in triangles, for cache locality.
  auto order = mesh::first_numbers(table.edges.size());
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return table.of(a).front().triangle < table.of(b).front().triangle;
  });
  for (const auto e : order) {
    const mesh::Edge& edge = table.edges[e];
    for (const auto& [triangle, forward] : table.of(e)) {
      MeanValueTriangle& view = views_[triangle];
      int i = 0;  // the corner opposite the edge
      while (view.corner[i] == edge[0] || view.corner[i] == edge[1]) ++i;
      view.edge[i] = static_cast<std::uint32_t>(edges_.size());
      view.sign[i] = forward ? 1 : -1;
    }
    edges_.push_back(edge);
  }
}

std::size_t Weigher::scratch_size() const {
  if (weighting_.smooth() && weighting_.in_space) return 2 * space().buffer_size();
  return bind_lanes * std::max(handles(), corners_.size()) +
         MeanValueJob::scratch_size(corners_.size(), edges_.size());
}

unsigned Weigher::weigh(std::span<const mesh::Point, bind_lanes> points, std::span<double> scratch,
                        LaneShares& shares) const {
  shares.fill(1);
  double at[3 * bind_lanes];
  for (std::size_t l = 0; l < bind_lanes; ++l) {
    const Vec3 p = scaled(points[l]);
    for (int i = 0; i < 3; ++i) at[i * bind_lanes + l] = p[i];
  }
  switch (weighting_.weights) {
    case pose::Weights::inverse: kernel_.inverse_distance(job(at), scratch.data()); return 0;
    case pose::Weights::cut_off:
      kernel_.cut_off(job(at), scratch.data(), shares.data());
      for (double& share : shares) share = std::min(share, 1.0);
      return 0;
    case pose::Weights::mean_value: return weigh_mean_values(points, at, scratch);
    case pose::Weights::harmonic:
    case pose::Weights::biharmonic:  // on a surface, these weights exist only at vertices
      if (weighting_.in_space)
        kernel_.in_space(space().job(at, scratch.data() + space().buffer_size()), scratch.data());
      return 0;
  }
  return 0;
}

WeightJob<double> Weigher::job(const double* at) const {
  return {triangles_.data(), numbers(shifts_), triangles_.size(), squared_contact(), cut(), at};
}

unsigned Weigher::weigh_mean_values(std::span<const mesh::Point, bind_lanes> points, const double* at,
                                    std::span<double> scratch) const {
  unsigned unclear =
      kernel_.mean_value({numbers(corners_), corners_.size(), numbers(edges_), edges_.size(), views_.data(),
                          views_.size(), at, scratch.data() + bind_lanes * corners_.size()},
                         scratch.data());
  share_centers(cage_, scratch.data(), bind_lanes);
  for (std::size_t l = 0; l < bind_lanes; ++l)
    unclear |= unsigned(touches(cage_, without_area_, points[l])) << l;
  unsigned failed = 0;
  std::vector<double> row(unclear ? handles() : 0);
  for (std::size_t l = 0; l < bind_lanes; ++l) {
    if (!(unclear >> l & 1)) continue;
    if (!mean_value_weights(cage_, points[l], row)) failed |= 1u << l;
    for (std::size_t j = 0; j < row.size(); ++j) scratch[j * bind_lanes + l] = row[j];
  }
  return failed;
}

double Weigher::squared_contact() const {
  return scale_ * cage_.contact * scale_ * cage_.contact;
}

double Weigher::cut() const {
  return 1 / (scale_ * cage_.size * weighting_.radius);
}

std::vector<bool> Weigher::weigh_tiles(std::span<const mesh::Point> points, float* rows, std::span<Vec3> sums,
                                       std::span<float> shares) const {
  std::vector<bool> failed(points.size());
  base::AlignedVector<double> scratch(scratch_size());  // unaligned data would take 10 % longer
  const bool in_float = weighting_.weights != pose::Weights::mean_value && !weighting_.smooth();
  const Vec3 middle = scaled(points[points.size() / 2]);
  std::vector<std::array<float, 3>> shifts(in_float ? handles() : 0);
  for (std::size_t e = 0; e < shifts.size(); ++e) {
    const Vec3 s = shift_of(triangles_[e], origins_[e] - middle);
    shifts[e] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
  }
  for (std::size_t s = 0; s < points.size(); s += lanes) {
    double tile_sums[3 * lanes];
    float totals[lanes];
    std::fill_n(totals, lanes, 1.0f);
    const RowJob out{numbers(handles_), handles(), rows + s * handles(), tile_sums, totals};
    if (!in_float || !weigh_in_float(points.subspan(s).first<lanes>(), middle, shifts, out)) {
      for (std::size_t half = 0; half < lanes; half += bind_lanes) {
        LaneShares exact;
        const unsigned lost = weigh(points.subspan(s + half).first<bind_lanes>(), scratch, exact);
        std::ranges::copy(exact, totals + half);
        kernel_.to_rows(scratch.data(), {out.handles, out.count, out.rows + half, out.sums + half});
        for (std::size_t l = 0; l < bind_lanes; ++l) failed[s + half + l] = lost >> l & 1;
      }
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      sums[s + l] = {tile_sums[l], tile_sums[lanes + l], tile_sums[2 * lanes + l]};
      shares[s + l] = std::min(totals[l], 1.0f);
    }
  }
  return failed;
}

bool Weigher::weigh_in_float(std::span<const mesh::Point, lanes> points, const Vec3& middle,
                             std::span<const std::array<float, 3>> shifts, const RowJob& out) const {
  float at[3 * lanes];
  for (std::size_t l = 0; l < lanes; ++l) {
    const Vec3 p = scaled(points[l]) - middle;
    for (int i = 0; i < 3; ++i) at[i * lanes + l] = static_cast<float>(p[i]);
  }
  const WeightJob<float> job{float_triangles_.data(),   numbers(shifts),
                             float_triangles_.size(),   static_cast<float>(squared_contact()),
                             static_cast<float>(cut()), at};
  const bool cut_off = weighting_.weights == pose::Weights::cut_off;
  return (cut_off ? kernel_.cut_off_rows : kernel_.inverse_distance_rows)(job, out);
}

}  // namespace viete::weights
