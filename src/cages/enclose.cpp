#include "cages/enclose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cages/subject.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"
#include "mesh/winding_number.h"

namespace viete::cages {

namespace {

using mesh::Point, mesh::Surface, mesh::Vec3;

double signed_volume(const Surface& cage) {
  const Point middle = mesh::used_bounds(cage).center();
  double six = 0;
  for (const auto& t : cage.triangles) {
    const Vec3 a = cage.positions[t[0]] - middle, b = cage.positions[t[1]] - middle,
               c = cage.positions[t[2]] - middle;
    six += mesh::dot(a, mesh::cross(b, c));
  }
  return six / 6;
}

// The outward motion of each vertex that encloses the outside points.
std::vector<Vec3> ways_outward(const Surface& cage, const std::vector<Point>& outside, double margin) {
  const mesh::TriangleTree tree(cage.positions, cage.triangles);
  std::vector<Vec3> ways(cage.positions.size(), {0, 0, 0});
  std::vector<double> farthest(cage.positions.size(), 0);
  const double side = signed_volume(cage) < 0 ? -1 : 1;  // normals of an inside-out cage point inward
  for (const Point& p : outside) {
    const auto nearest = tree.nearest(p);
    const mesh::Triangle& t = cage.triangles[nearest.triangle];
    const Vec3 area =
        mesh::cross(cage.positions[t[1]] - cage.positions[t[0]], cage.positions[t[2]] - cage.positions[t[0]]);
    const double length = mesh::norm(area);
    if (!(length > 0)) continue;
    const double distance = std::sqrt(nearest.squared_distance) + margin;
    for (const auto v : t) {
      if (distance <= farthest[v]) continue;
      farthest[v] = distance;
      ways[v] = (side * distance / length) * area;
    }
  }
  return ways;
}

// The nearest point at this distance outside of the model; p itself if it is already there.
Point way_out(const Point& p, const Surface& model, const mesh::TriangleTree& tree, double distance) {
  constexpr double enough = 0.999;  // reached up to rounding
  const mesh::Triangle& t = model.triangles[tree.nearest(p).triangle];
  const Point &a = model.positions[t[0]], &b = model.positions[t[1]], &c = model.positions[t[2]];
  const mesh::Closest closest = mesh::closest_on_triangle(p, a, b, c);
  const bool within = std::abs(tree.winding_number(p)) > 0.5;
  const double gap = std::sqrt(closest.squared_distance);
  if (!within && gap >= enough * distance) return p;
  const Vec3& share = closest.barycentric;
  const Point border = share[0] * a + share[1] * b + share[2] * c;
  Vec3 way = within ? border - p : p - border;
  // On the surface the direction is undefined; uses its normal.
  if (gap < 1e-6 * distance) way = mesh::cross(b - a, c - a);
  const double length = mesh::norm(way);
  return length > 0 ? border + (distance / length) * way : p;
}

}  // namespace

Fitted fitted_to_box(const Surface& cage, const Surface& model, double margin) {
  const mesh::Bounds from = mesh::used_bounds(cage), to = mesh::used_bounds(model);
  const double more = 2 * margin * to.diagonal();
  double scale = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = from.high[k] - from.low[k];
    if (extent > 1e-6 * from.diagonal()) scale = std::max(scale, (to.high[k] - to.low[k] + more) / extent);
  }
  Fitted fitted{cage.positions, {{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}}}};
  for (Point& p : fitted.positions) p = to.center() + scale * (p - from.center());
  return fitted;
}

Enclosing enclose(const Surface& cage, const Surface& model, double margin) {
  constexpr int most_rounds = 40;
  const double distance = margin * mesh::used_bounds(model).diagonal();
  Surface moved = cage;
  // Rechecks the vertices that were outside until none is; then all, because the motion may expose others.
  std::vector<Point> asked = model.positions;
  for (int round = 0;; ++round) {
    const auto outside = mesh::points_outside(moved, asked);
    const bool all = asked.size() == model.positions.size();
    if (all && (outside.empty() || round >= most_rounds)) return {std::move(moved.positions), outside.size()};
    if (outside.empty() || round >= most_rounds) {
      asked = model.positions;
      continue;
    }
    std::vector<Point> points;
    for (const auto p : outside) points.push_back(asked[p]);
    const auto ways = ways_outward(moved, points, distance);
    for (std::size_t v = 0; v < ways.size(); ++v) moved.positions[v] = moved.positions[v] + ways[v];
    mesh::triangulate(moved);
    asked = std::move(points);
  }
}

SnappedOutside snap_outside(const Surface& cage, std::span<const std::uint32_t> vertices,
                            const Surface& model, double margin) {
  constexpr int most_rounds = 20;
  const double distance = margin * mesh::used_bounds(model).diagonal();
  const mesh::TriangleTree tree(model.positions, model.triangles);
  SnappedOutside snapped{cage.positions};
  for (const auto v : vertices) {
    Point p = cage.positions[v], before;
    int round = 0;
    do {
      before = p;
      p = way_out(before, model, tree, distance);
    } while (p != before && ++round < most_rounds);
    if (p != before) {
      ++snapped.left;
    } else if (p != cage.positions[v]) {
      snapped.positions[v] = p;
      ++snapped.moved;
    }
  }
  return snapped;
}

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr std::size_t few = 100, many = 300;  // samples of each surface, for the choice and for the fit

Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}
Point point(const Vector3d& v) {
  return {v[0], v[1], v[2]};
}

struct Similarity {
  Matrix3d rotation = Matrix3d::Identity();
  double scale = 1;
  Vector3d shift = Vector3d::Zero();

  Point of(const Point& p) const { return point(scale * (rotation * vector(p)) + shift); }
  Point back(const Point& p) const { return point(rotation.transpose() * (vector(p) - shift) / scale); }
};

// Samples spread evenly over the area, in triangle order; vertices if there is no area.
std::vector<Point> samples_of(const FramedModel& surface, std::size_t count) {
  std::vector<double> areas;
  double total = 0;
  for (const auto& t : surface.triangles) {
    const Point &a = surface.positions[t[0]], &b = surface.positions[t[1]], &c = surface.positions[t[2]];
    areas.push_back(total += mesh::norm(mesh::cross(b - a, c - a)));
  }
  std::vector<Point> samples;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(total > 0)) {
      samples.push_back(surface.positions[surface.triangles[n * surface.triangles.size() / count][0]]);
      continue;
    }
    const double at = (static_cast<double>(n) + 0.5) / static_cast<double>(count) * total;
    const auto t = std::min<std::size_t>(
        static_cast<std::size_t>(std::ranges::lower_bound(areas, at) - areas.begin()), areas.size() - 1);
    // A low-discrepancy sequence in the square, folded into the triangle.
    double unused = 0, u = std::modf(0.5 + 0.7548776662466927 * static_cast<double>(n), &unused),
           v = std::modf(0.5 + 0.5698402909980532 * static_cast<double>(n), &unused);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = surface.triangles[t];
    const Point& corner = surface.positions[a];
    samples.push_back(corner + u * (surface.positions[b] - corner) + v * (surface.positions[c] - corner));
  }
  return samples;
}

// Reduces a fine surface to samples.
FramedModel coarse(FramedModel surface) {
  constexpr std::size_t enough = 20'000;
  if (surface.triangles.size() <= enough) return surface;
  FramedModel points{samples_of(surface, enough), {}, {}, false};
  for (std::uint32_t v = 0; v < enough; ++v) points.triangles.push_back({v, v, v});
  return points;
}

// A surface for nearest-point queries, and its samples.
class Sampled {
public:
  explicit Sampled(FramedModel surface)
      : surface_(coarse(std::move(surface))), tree_(surface_.positions, surface_.triangles) {
    choosing = samples_of(surface_, few);
    fitting = samples_of(surface_, many);
  }

  mesh::Point nearest(const Point& p) const {
    const auto& [a, b, c] = surface_.triangles[tree_.nearest(p).triangle];
    const Point &x = surface_.positions[a], &y = surface_.positions[b], &z = surface_.positions[c];
    const Vec3 share = mesh::closest_on_triangle(p, x, y, z).barycentric;
    return share[0] * x + share[1] * y + share[2] * z;
  }

  std::vector<Point> choosing, fitting;

private:
  FramedModel surface_;
  mesh::TriangleTree tree_;
};

Vector3d mean_of(const std::vector<Point>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Point& p : points) sum += vector(p);
  return sum / static_cast<double>(points.size());
}

double radius_of(const std::vector<Point>& points, const Vector3d& mean) {
  double sum = 0;
  for (const Point& p : points) sum += (vector(p) - mean).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

// The rotations that align the axes of the frames.
std::vector<Matrix3d> rotations(const Frame& from, const Frame& to) {
  Matrix3d a, b;
  for (int k = 0; k < 3; ++k) {
    a.row(k) = vector(from.axes[static_cast<std::size_t>(k)]);
    b.row(k) = vector(to.axes[static_cast<std::size_t>(k)]);
  }
  std::vector<Matrix3d> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d p = Matrix3d::Zero();
      for (int k = 0; k < 3; ++k) p(k, order[static_cast<std::size_t>(k)]) = (signs >> k) & 1 ? -1 : 1;
      if (p.determinant() > 0) all.push_back(b.transpose() * p * a);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

// Fits the cage to the model, each in its own frame.
class Fitting {
public:
  Fitting(const Sampled& cage, const Sampled& model, base::Progress* progress)
      : cage_(cage), model_(model), progress_(progress) {}

  struct Laid {
    Similarity similarity;
    double squared = 0;  // mean squared distance
  };

  Laid start(const Matrix3d& rotation) const {
    const Vector3d from = mean_of(cage_.fitting), to = mean_of(model_.fitting);
    const double scale = radius_of(model_.fitting, to) / radius_of(cage_.fitting, from);
    return {{rotation, scale, to - scale * (rotation * from)}};
  }

  // Mean squared distance.
  double squared(const Similarity& similarity) const { return pairs_of(similarity, false).squared; }

  // Iterated closest points until the improvement is small.
  void refine(Laid& laid, bool choosing, int rounds) const {
    for (int round = 0; round < rounds; ++round) {
      const double before = laid.squared;
      const Pairs pairs = pairs_of(laid.similarity, choosing);
      laid.squared = pairs.squared;
      if (round > 0 && laid.squared > (1 - 1e-4) * before) return;
      laid.similarity = similarity_of(pairs, laid.similarity);
      if (progress_) progress_->report(0.5);
    }
    laid.squared = pairs_of(laid.similarity, choosing).squared;
  }

private:
  struct Pairs {
    Eigen::Matrix3Xd cage, model;
    double squared = 0;
  };

  Pairs pairs_of(const Similarity& similarity, bool choosing) const {
    const auto& outer = choosing ? cage_.choosing : cage_.fitting;
    const auto& inner = choosing ? model_.choosing : model_.fitting;
    const auto count = static_cast<Eigen::Index>(outer.size() + inner.size());
    Pairs pairs{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
    Eigen::Index at = 0;
    for (const Point& p : outer) {
      pairs.cage.col(at) = vector(p);
      pairs.model.col(at++) = vector(model_.nearest(similarity.of(p)));
    }
    for (const Point& p : inner) {
      pairs.cage.col(at) = vector(cage_.nearest(similarity.back(p)));
      pairs.model.col(at++) = vector(p);
    }
    const Eigen::Matrix3Xd moved =
        (similarity.scale * similarity.rotation * pairs.cage).colwise() + similarity.shift;
    pairs.squared = (moved - pairs.model).colwise().squaredNorm().mean();
    return pairs;
  }

  // The similarity before, if undefined.
  static Similarity similarity_of(const Pairs& pairs, const Similarity& before) {
    const Eigen::Matrix4d best = Eigen::umeyama(pairs.cage, pairs.model, true);
    const Matrix3d linear = best.topLeftCorner<3, 3>();
    const double scale = std::cbrt(linear.determinant());
    if (!(scale > 1e-6 && scale < 1e6)) return before;
    return {linear / scale, scale, best.topRightCorner<3, 1>()};
  }

  const Sampled& cage_;
  const Sampled& model_;
  base::Progress* progress_;
};

using Laid = Fitting::Laid;

double angle_of(const Laid& laid) {
  return Eigen::AngleAxisd(laid.similarity.rotation).angle();
}

// The best fit; the smallest rotation among nearly equal ones.
const Laid& chosen(const std::vector<Laid>& all) {
  constexpr double as_good = 1.05, rounding = 1e-12;
  const double best = std::ranges::min_element(all, {}, &Laid::squared)->squared;
  const Laid* least = nullptr;
  for (const Laid& c : all) {
    if (c.squared <= as_good * best + rounding && (!least || angle_of(c) < angle_of(*least))) least = &c;
  }
  return *least;
}

Laid fit(const Sampled& cage, const Sampled& model, const std::vector<Matrix3d>& starts,
         base::Progress* progress) {
  constexpr std::size_t refined = 3;
  const Fitting fitting(cage, model, progress);
  std::vector<Laid> all;
  for (const Matrix3d& rotation : starts) {
    all.push_back(fitting.start(rotation));
    fitting.refine(all.back(), true, 8);
  }
  std::stable_sort(all.begin() + 1, all.end(),
                   [](const auto& a, const auto& b) { return a.squared < b.squared; });
  all.resize(std::min(all.size(), refined + 1));
  for (Laid& laid : all) fitting.refine(laid, false, 40);
  return chosen(all);
}

}  // namespace

Fitted best_fit(const mesh::Surface& cage, const mesh::Surface& model, double margin,
                base::Progress* progress) {
  const Frame from = frame_of(cage, std::nullopt), to = frame_of(model, std::nullopt);
  std::vector<Matrix3d> starts = {Matrix3d::Identity()};
  for (const Matrix3d& r : rotations(own_frame(cage), own_frame(model))) starts.push_back(r);
  const Sampled framed(shape_in(to, model));
  const Laid best = fit(Sampled(shape_in(from, cage)), framed, starts, progress);

  mesh::Surface turned = cage;
  for (Point& p : turned.positions) p = to.out_of(best.similarity.of(from.into(p)));
  Fitted fitted = fitted_to_box(turned, model, margin), plain = fitted_to_box(cage, model, margin);
  const auto distance = [&](const Fitted& f) {
    turned.positions = f.positions;
    return Fitting(Sampled(shape_in(to, turned)), framed, progress).squared({});
  };
  constexpr double as_good = 1.2 * 1.2;
  if (distance(plain) <= as_good * distance(fitted)) return plain;
  const Matrix3d linear =
      fitted.linear[0][0] * best.similarity.scale * from.scale / to.scale * best.similarity.rotation;
  for (int k = 0; k < 3; ++k) fitted.linear[static_cast<std::size_t>(k)] = point(linear.row(k));
  fitted.degrees = angle_of(best) * 180 / std::numbers::pi;
  return fitted;
}

}  // namespace viete::cages
