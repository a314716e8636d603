#include "cages/subject.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/summary.h"

namespace viete::cages {

namespace {

constexpr std::size_t samples = 200;
constexpr double tolerance = 0.02, fine = 1e-3;  // relative to the diagonal

Point reflected(const Point& p, const Plane& plane) {
  return p - (2 * (mesh::dot(plane.normal, p) - plane.offset)) * plane.normal;
}

Vec3 unit(const Vec3& v) {
  const double length = mesh::norm(v);
  return length > 0 ? (1 / length) * v : Vec3{1, 0, 0};
}

// Finds a plane of symmetry. The model must have diagonal 1.
class Search {
public:
  Search(const std::vector<Point>& positions, const mesh::TriangleTree& tree, base::Progress* progress)
      : tree_(tree), progress_(progress) {
    for (std::size_t n = 0; n < samples; ++n) points_.push_back(positions[n * positions.size() / samples]);
  }

  // Returns the largest distance from a mirrored sample to the model. Stops early at a distance above `most`.
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

  // Changes the offset and the tilt of the plane in small steps while the error decreases.
  Plane fitted(Plane plane) const {
    double best = mean_error(plane, tolerance);
    for (double step = 0.02; step > 2e-4; step *= 0.5)
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

using Matrix = std::array<Vec3, 3>;

Matrix eigenvectors(Matrix a) {
  Matrix v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 12; ++sweep)
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) < 1e-300) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = std::copysign(1, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = a[k][p], y = a[k][q];
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = a[p][k], y = a[q][k];
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
        const double u = v[k][p], w = v[k][q];
        v[k][p] = c * u - s * w;
        v[k][q] = s * u + c * w;
      }
    }
  return v;
}

// Calls visit(position, weight) for weighted points. Together, the points have the area, mean and inertia of
// the triangles. If `has_area` is false, visits the vertices with weight 1 instead.
template <class Visit>
void for_moments(const mesh::Surface& surface, const Frame& frame, bool has_area, Visit&& visit) {
  if (!has_area) {
    for (const Point& p : surface.positions) visit(frame.into(p), 1.0);
    return;
  }
  for (const auto& t : surface.triangles) {
    const Point a = frame.into(surface.positions[t[0]]), b = frame.into(surface.positions[t[1]]),
                c = frame.into(surface.positions[t[2]]);
    const double weight = mesh::norm(mesh::cross(b - a, c - a)) / 12;
    for (const Point& p : {a, b, c}) visit(p, weight);
    visit((1.0 / 3) * (a + b + c), 9 * weight);
  }
}

FramedModel centered(FramedModel model, bool mirrored) {
  if (!mirrored) return model;
  const double x = std::max(-model.box.low[0], model.box.high[0]);
  model.box.low[0] = -x;
  model.box.high[0] = x;
  return model;
}

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
    normal[k % 3] = 1;                                                           // k >= 3: an axis of inertia
    if (k < 3) normal = {frame.axes[0][k], frame.axes[1][k], frame.axes[2][k]};  // k < 3: an axis of the file
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

mesh::Bounds extent_of(const mesh::Surface& surface) {
  return surface.triangles.empty() ? mesh::bounds(surface.positions) : mesh::used_bounds(surface);
}

Frame frame_of(const mesh::Surface& model, const std::optional<Plane>& mirror) {
  const mesh::Bounds box = extent_of(model);
  Frame frame{box.center(), 1 / box.diagonal()};
  if (!mirror) return frame;
  const Vec3& n = mirror->normal;
  frame.center = frame.center - (mesh::dot(n, frame.center) - mirror->offset) * n;
  Vec3 least{0, 0, 0};
  least[static_cast<std::size_t>(std::ranges::min_element(n, {}, [](double x) { return std::abs(x); }) -
                                 n.begin())] = 1;
  const Vec3 u = mesh::cross(n, least);
  frame.axes[0] = n;
  frame.axes[1] = (1 / mesh::norm(u)) * u;
  frame.axes[2] = mesh::cross(n, frame.axes[1]);
  return frame;
}

Frame own_frame(const mesh::Surface& model) {
  Frame frame = frame_of(model, std::nullopt);
  double total = 0;
  Point mean{0, 0, 0};
  const auto add = [&](const Point& p, double weight) {
    total += weight;
    mean = mean + weight * p;
  };
  for_moments(model, frame, true, add);
  const bool has_area = total > 1e-12;
  if (!has_area) for_moments(model, frame, false, add);
  mean = (1 / total) * mean;
  Matrix inertia{};
  for_moments(model, frame, has_area, [&](const Point& p, double weight) {
    for (std::size_t i = 0; i < 3; ++i)
      inertia[i] = inertia[i] + (weight / total * (p[i] - mean[i])) * (p - mean);
  });
  const Matrix v = eigenvectors(inertia);
  frame.axes[0] = {v[0][0], v[1][0], v[2][0]};
  frame.axes[1] = {v[0][1], v[1][1], v[2][1]};
  frame.axes[2] = mesh::cross(frame.axes[0], frame.axes[1]);
  return frame;
}

FramedModel model_in(const Frame& frame, const mesh::Surface& surface) {
  FramedModel model{surface.positions, surface.triangles, {}, false};
  for (Point& p : model.positions) p = frame.into(p);
  if (model.triangles.empty()) {
    for (std::uint32_t v = 0; v < model.positions.size(); ++v) model.triangles.push_back({v, v, v});
  }
  std::vector<std::uint32_t> used;
  for (const auto& t : model.triangles) used.insert(used.end(), t.begin(), t.end());
  model.box = mesh::bounds(model.positions, used);
  // Removes duplicates: if a polygon repeats corners, its triangulation can contain equal triangles.
  std::set<mesh::Triangle> seen;
  const std::size_t copies = std::erase_if(model.triangles, [&](mesh::Triangle t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return !seen.insert(t).second;
  });
  const mesh::Summary summary =
      mesh::summarize(copies == 0 ? surface : mesh::from_triangles(surface.positions, model.triangles));
  model.closed = summary.closed() && summary.manifold() && summary.oriented();
  return model;
}

Subject::Subject(const mesh::Surface& surface, const std::optional<Plane>& plane, base::Progress* progress)
    : mirror(plane),
      frame(frame_of(surface, plane)),
      model(centered(model_in(frame, surface), plane.has_value())),
      tree(model.positions, model.triangles, progress) {}

}  // namespace viete::cages
