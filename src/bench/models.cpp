#include "bench/models.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>

namespace viete::bench {

namespace {

using mesh::cross, mesh::dot, mesh::Point;

// A spiral of points from pole to pole (Fibonacci lattice).
std::vector<Point> directions(std::size_t count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Point> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double r = std::sqrt(1 - z * z), a = golden * static_cast<double>(i);
    result[i] = {r * std::cos(a), r * std::sin(a), z};
  }
  return result;
}

bool sees(const std::vector<Point>& p, const mesh::Triangle& t, const Point& x) {
  return dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), x - p[t[0]]) > 0;
}

// Convex hull, one point after the other: what a point sees is replaced by a fan over its rim.
std::vector<mesh::Triangle> hull(const std::vector<Point>& p) {
  std::vector<mesh::Triangle> triangles = {{0, 1, 2}, {0, 2, 1}};
  for (std::uint32_t i = 3; i < p.size(); ++i) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> rim;
    const auto seen = std::stable_partition(triangles.begin(), triangles.end(),
                                            [&](const auto& t) { return !sees(p, t, p[i]); });
    for (auto t = seen; t != triangles.end(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::pair edge{(*t)[c], (*t)[(c + 1) % 3]};
        if (!rim.erase({edge.second, edge.first})) rim.insert(edge);
      }
    }
    triangles.erase(seen, triangles.end());
    for (const auto& [a, b] : rim) triangles.push_back({a, b, i});
  }
  return triangles;
}

// x as a non-negative combination of a triangle's corners, if it lies in its cone.
std::optional<Point> in_cone(const std::vector<Point>& p, const mesh::Triangle& t, const Point& x) {
  const Point &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
  const double volume = dot(a, cross(b, c));
  const Point w{dot(x, cross(b, c)) / volume, dot(a, cross(x, c)) / volume, dot(a, cross(b, x)) / volume};
  if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) return std::nullopt;
  return w;
}

// A triangle whose corners are as far out as w_0 + w_1 + w_2 of each point above it has them all inside.
std::vector<double> radii_around(const mesh::Surface& model, const Point& center,
                                 const std::vector<Point>& directions,
                                 const std::vector<mesh::Triangle>& triangles) {
  std::vector<double> radii(directions.size(), 0.05 * mesh::bounds(model.positions).diagonal());
  std::size_t last = 0;
  for (const Point& v : model.positions) {
    const Point x = v - center;
    std::optional<Point> w;
    for (std::size_t n = 0; n < triangles.size() && !w; ++n) {
      const std::size_t t = (last + n) % triangles.size();
      if ((w = in_cone(directions, triangles[t], x))) last = t;
    }
    if (!w) continue;
    for (const auto corner : triangles[last])
      radii[corner] = std::max(radii[corner], (*w)[0] + (*w)[1] + (*w)[2]);
  }
  return radii;
}

}  // namespace

scene::Document open_model(const std::filesystem::path& model, const std::filesystem::path& cage) {
  scene::Document document = scene::open_document(model, cage);
  scene::check_drawable(document);
  return document;
}

mesh::Surface subdivided(const mesh::Surface& surface) {
  std::vector<Point> positions = surface.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
    if (fresh) {
      const Point p = positions[a], q = positions[b];
      positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    }
    return at->second;
  };
  std::vector<mesh::Triangle> triangles;
  for (const auto& t : surface.triangles) {
    const auto a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    triangles.insert(triangles.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
  }
  return mesh::from_triangles(std::move(positions), triangles);
}

mesh::Surface star_cage(const mesh::Surface& model, std::size_t faces) {
  const auto unit = directions(faces / 2 + 2);
  const auto triangles = hull(unit);
  const Point center = mesh::bounds(model.positions).center();
  const auto radii = radii_around(model, center, unit, triangles);
  std::vector<Point> positions(unit.size());
  for (std::size_t i = 0; i < unit.size(); ++i) {
    for (int k = 0; k < 3; ++k) positions[i][k] = center[k] + 1.06 * radii[i] * unit[i][k];
  }
  return mesh::from_triangles(std::move(positions), triangles);
}

deform::Pose moderate_pose(const deform::Cage& cage) {
  const auto box = mesh::bounds(cage.surface.positions);
  const Point size = box.high - box.low, middle = box.center();
  const int z = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  std::mt19937_64 random(20160101);
  std::uniform_real_distribution<double> noise(-0.01 * cage.diagonal, 0.01 * cage.diagonal);
  deform::Pose pose = deform::rest_pose(cage);
  for (auto& p : pose.positions) {
    const double along = (p[z] - middle[z]) / size[z], twist = 0.8 * along, bend = 0.5 * along;
    const double u = p[x] - middle[x], v = p[y] - middle[y], w = 1.2 * (p[z] - middle[z]);
    const double a = u * std::cos(twist) - v * std::sin(twist), b = u * std::sin(twist) + v * std::cos(twist);
    p[x] = middle[x] + a * std::cos(bend) - w * std::sin(bend) + noise(random);
    p[z] = middle[z] + a * std::sin(bend) + w * std::cos(bend) + noise(random);
    p[y] = middle[y] + b + noise(random);
  }
  return pose;
}

}  // namespace viete::bench
