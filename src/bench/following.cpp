#include "bench/following.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/median.h"
#include "mesh/normals.h"
#include "mesh/triangle.h"

namespace viete::bench {

namespace {

using mesh::norm, mesh::Point;

Point moved_by(const WholePose& pose, const Point& middle, double diagonal, const Point& p) {
  const auto& m = pose.linear;
  const Point x = p - middle;
  return Point{m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
               m[6] * x[0] + m[7] * x[1] + m[8] * x[2]} +
         middle + diagonal * pose.shift;
}

sym3::Mat3<double> turned(double scale) {
  auto m = sym3::exp_rotation<double>({0.7, -1.1, 0.9});
  for (double& x : m) x *= scale;
  return m;
}

// Vertices of the cage's triangles, spread evenly over their numbers.
std::vector<std::uint32_t> spread_cage_vertices(const deform::Cage& cage, std::size_t limit) {
  std::vector<std::uint32_t> used;
  for (const auto& t : cage.surface.triangles) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const std::size_t count = std::min(limit, used.size());
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(used[i * used.size() / count]);
  return chosen;
}

std::vector<Point> cage_normals(const mesh::Surface& cage) {
  std::vector<Point> normals(cage.positions.size());
  mesh::vertex_normals(cage.positions, cage.triangles,
                       mesh::vertex_triangles(cage.positions.size(), cage.triangles), 0,
                       cage.positions.size(), normals);
  return normals;
}

}  // namespace

std::span<const WholePose> whole_poses() {
  static const std::array<WholePose, 4> poses = {
      WholePose{"translation", {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.3, -0.2, 0.4}},
      WholePose{"rigid", turned(1), {0.3, -0.2, 0.4}}, WholePose{"similarity", turned(1.3), {0.3, -0.2, 0.4}},
      WholePose{"affine", {1.2, 0.3, -0.1, -0.2, 0.9, 0.25, 0.15, -0.35, 1.1}, {0.3, -0.2, 0.4}}};
  return poses;
}

double deviation(const WholePose& pose, const deform::Cage& cage, std::span<const Point> model,
                 const Deform& deform) {
  const Point middle = mesh::used_bounds(cage.surface).center();
  mesh::Surface posed = cage.surface;
  for (Point& p : posed.positions) p = moved_by(pose, middle, cage.diagonal, p);
  const std::vector<Point> positions = deform({posed.positions, {}});
  double largest = 0;
  for (std::size_t v = 0; v < model.size(); ++v) {
    const double off = norm(positions[v] - moved_by(pose, middle, cage.diagonal, model[v]));
    largest = std::isnan(largest) || off <= largest ? largest : off;  // NaN counts
  }
  return largest / mesh::used_bounds(posed).diagonal();
}

double leak(const deform::Cage& cage, std::span<const Point> model, const Deform& deform) {
  const std::vector<Point> normals = cage_normals(cage.surface);
  const std::vector<Point> rest = deform(deform::rest_pose(cage));
  std::vector<double> medians;
  for (const auto v : spread_cage_vertices(cage, 8)) {
    deform::Pose pose = deform::rest_pose(cage);
    const Point from = pose.positions[v];
    pose.positions[v] = from + 0.1 * cage.diagonal * normals[v];
    const std::vector<Point> positions = deform(pose);
    std::vector<double> motions;
    for (std::size_t i = 0; i < model.size(); ++i) {
      if (norm(model[i] - from) <= 0.25 * cage.diagonal) continue;
      const double motion = norm(positions[i] - rest[i]);
      motions.push_back(std::isnan(motion) ? HUGE_VAL : motion);  // the median takes no NaN
    }
    if (!motions.empty()) medians.push_back(base::median(std::move(motions)) / cage.diagonal);
  }
  return medians.empty() ? std::numeric_limits<double>::quiet_NaN() : base::median(std::move(medians));
}

std::vector<CagePoint> nearest_on_cage(const deform::Cage& cage, std::span<const Point> points,
                                       base::WorkerPool& pool) {
  const auto& p = cage.surface.positions;
  const auto& triangles = cage.surface.triangles;
  std::vector<CagePoint> nearest(points.size());
  pool.for_blocks(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const mesh::Closest found = mesh::closest_on_triangle(points[i], p[a], p[b], p[c]);
        if (!(found.squared_distance < least)) continue;
        least = found.squared_distance;
        nearest[i] = {t, found.barycentric};
      }
    }
  });
  return nearest;
}

double gap(const deform::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const Point> posed_cage, std::span<const Point> points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [triangle, w] = nearest[i];
    const auto& [a, b, c] = cage.surface.triangles[triangle];
    sum += shares[i] * norm(points[i] - (w[0] * posed_cage[a] + w[1] * posed_cage[b] + w[2] * posed_cage[c]));
  }
  return sum / cage.diagonal;
}

}  // namespace viete::bench
