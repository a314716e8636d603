#include "cages/mirror.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cages/frame.h"

namespace viete::cages {

namespace {

constexpr std::size_t samples = 200;
constexpr double tolerance = 0.02, fine = 1e-3;  // of the diagonal

Point reflected(const Point& p, const Plane& plane) {
  return p - (2 * (mesh::dot(plane.normal, p) - plane.offset)) * plane.normal;
}

Vec3 unit(const Vec3& v) {
  const double length = mesh::norm(v);
  return length > 0 ? (1 / length) * v : Vec3{1, 0, 0};
}

// Planes are looked for where the model is unit in size.
class Search {
public:
  Search(const std::vector<Point>& positions, const mesh::TriangleTree& tree, base::Progress* progress)
      : tree_(tree), progress_(progress) {
    for (std::size_t n = 0; n < samples; ++n) points_.push_back(positions[n * positions.size() / samples]);
  }

  // The largest distance of a sample's image to the model, or any number above `most` if it is above that.
  double error(const Plane& plane, double most) const {
    double worst = 0;
    for (const Point& p : points_) {
      worst = std::max(worst, tree_.nearest(reflected(p, plane)).squared_distance);
      if (worst > most * most) break;
    }
    return std::sqrt(worst);
  }

  double mean_error(const Plane& plane, double most) const {
    const auto count = static_cast<double>(points_.size());
    double sum = 0;
    if (progress_) progress_->report(1);
    for (const Point& p : points_) {
      sum += std::sqrt(tree_.nearest(reflected(p, plane)).squared_distance);
      if (sum > most * count) break;
    }
    return sum / count;
  }

  // Steps along the offset and two tilts, shorter when none is better.
  Plane fitted(Plane plane) const {
    double best = mean_error(plane, tolerance);
    for (double step = 0.02; step > 2e-4; step *= 0.5) {
      for (bool better = true; better;) {
        better = false;
        for (const Plane& next : neighbors(plane, step)) {
          const double error = mean_error(next, best);
          if (error >= best * (1 - 1e-9)) continue;
          best = error;
          plane = next;
          better = true;
        }
      }
    }
    return plane;
  }

private:
  static std::vector<Plane> neighbors(const Plane& plane, double step) {
    std::vector<Plane> all = {{plane.normal, plane.offset + step}, {plane.normal, plane.offset - step}};
    const Vec3 other = std::abs(plane.normal[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = unit(mesh::cross(plane.normal, other)), w = mesh::cross(plane.normal, u);
    for (const Vec3& tilt : {step * u, -step * u, step * w, -step * w})
      all.push_back({unit(plane.normal + tilt), plane.offset});
    return all;
  }

  const mesh::TriangleTree& tree_;
  base::Progress* progress_;
  std::vector<Point> points_;
};

}  // namespace

Shell whole(const Shell& half) {
  Shell all = half;
  std::vector<std::uint32_t> image(half.positions.size());
  for (std::size_t v = 0; v < half.positions.size(); ++v) {
    const Point& p = half.positions[v];
    image[v] = static_cast<std::uint32_t>(p[0] == 0 ? v : all.positions.size());
    if (p[0] != 0) all.positions.push_back({-p[0], p[1], p[2]});
  }
  for (const auto& t : half.triangles) all.triangles.push_back({image[t[0]], image[t[2]], image[t[1]]});
  return all;
}

std::optional<Plane> symmetry_plane(const mesh::Surface& surface, base::Progress* progress) {
  if (surface.triangles.empty()) return std::nullopt;
  const Frame frame = own_frame(surface);
  const FramedModel model = model_in(frame, surface);
  const mesh::TriangleTree tree(model.positions, model.triangles, progress);
  std::vector<Point> middles;
  Point mean{0, 0, 0};
  for (const auto& t : model.triangles) {
    middles.push_back((1.0 / 3) * (model.positions[t[0]] + model.positions[t[1]] + model.positions[t[2]]));
    mean = mean + (1 / static_cast<double>(model.triangles.size())) * middles.back();
  }
  const Point file_middle = frame.into(mesh::used_bounds(surface).center());
  const Search search(middles, tree, progress);
  std::optional<Plane> best;
  double least = tolerance;
  for (std::size_t k = 0; k < 6; ++k) {
    Vec3 normal{0, 0, 0};
    normal[k % 3] = 1;                                                           // of inertia
    if (k < 3) normal = {frame.axes[0][k], frame.axes[1][k], frame.axes[2][k]};  // of the file
    Plane plane{normal, mesh::dot(normal, k < 3 ? file_middle : mean)};
    if (search.error(plane, fine) > fine && search.mean_error(plane, tolerance) < tolerance)
      plane = search.fitted(plane);
    const double error = search.error(plane, tolerance);
    if (error >= least * (1 - 1e-6)) continue;
    least = error;
    best = plane;
  }
  if (!best) return std::nullopt;
  const Vec3& n = best->normal;
  const Vec3 normal = n[0] * frame.axes[0] + n[1] * frame.axes[1] + n[2] * frame.axes[2];
  return Plane{normal, mesh::dot(normal, frame.out_of(best->offset * n))};
}

}  // namespace viete::cages
