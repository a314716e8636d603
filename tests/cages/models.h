// Models of many kinds for cage making. Each model has a name.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/shapes.h"
#include "support/skip.h"

namespace viete::test {

inline Surface stretched(Surface s, const Point& factors, const Point& offset = {0, 0, 0}) {
  for (Point& p : s.positions)
    for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] * factors[k] + offset[k];
  return s;
}

inline Surface turned(Surface s, double angle) {
  const double c = std::cos(angle), d = std::sin(angle);
  for (Point& p : s.positions)
    p = {c * p[0] - d * p[1], c * c * p[1] + c * d * p[0] - d * p[2], d * c * p[1] + d * d * p[0] + c * p[2]};
  return s;
}

/// Returns the boundary of the cells (i, j, k) in [0, n)^3 that are inside. Edges can have four triangles.
inline Surface of_cells(int n, const std::function<bool(int, int, int)>& inside) {
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  const auto full = [&](std::array<int, 3> c) {
    for (const int x : c)
      if (x < 0 || x >= n) return false;
    return inside(c[0], c[1], c[2]);
  };
  const auto vertex = [&](const std::array<int, 3>& c) {
    const auto [at, added] = numbers.try_emplace(c, static_cast<std::uint32_t>(points.size()));
    if (added) points.push_back({1.0 * c[0], 1.0 * c[1], 1.0 * c[2]});
    return at->second;
  };
  for (int i = 0; i < n * n * n; ++i) {
    const std::array<int, 3> cell = {i % n, i / n % n, i / n / n};
    if (!full(cell)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        auto beside = cell;
        beside[axis] += 2 * side - 1;
        if (full(beside)) continue;
        std::array<std::uint32_t, 4> corners{};
        for (std::size_t c = 0; c < 4; ++c) {
          auto at = cell;
          at[axis] += side;
          at[(axis + 1) % 3] += c == 1 || c == 2;
          at[(axis + 2) % 3] += c >= 2;
          corners[side ? c : 3 - c] = vertex(at);
        }
        triangles.push_back({corners[0], corners[1], corners[2]});
        triangles.push_back({corners[0], corners[2], corners[3]});
      }
  }
  return mesh::from_triangles(points, triangles);
}

/// Returns random triangles of about the size `size`, in a cube with side 2.
inline Surface soup(std::size_t count, double size, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> at(-1, 1);
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t t = 0; t < count; ++t) {
    const Point middle = {at(engine), at(engine), at(engine)};
    for (int i = 0; i < 3; ++i)
      points.push_back(
          {middle[0] + size * at(engine), middle[1] + size * at(engine), middle[2] + size * at(engine)});
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh::from_triangles(points, triangles);
}

inline Surface points_only(std::vector<Point> points) {
  return mesh::from_triangles(std::move(points), {});
}

/// Returns a flat grid of n x n quads. Leaves out the quads for which `hole` is true.
inline Surface sheet(int n, const std::function<bool(int, int)>& hole) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) s.positions.push_back({1.0 * i, 1.0 * j, 0});
  std::vector<Triangle> triangles;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (hole(i, j)) continue;
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i), b = a + static_cast<std::uint32_t>(n) + 1;
      triangles.insert(triangles.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  return mesh::from_triangles(s.positions, triangles);
}

inline Surface without_lower_half(const Surface& s) {
  std::vector<Triangle> kept;
  for (const auto& t : s.triangles)
    if (s.positions[t[0]][2] + s.positions[t[1]][2] + s.positions[t[2]][2] > 0) kept.push_back(t);
  return mesh::from_triangles(s.positions, kept);
}

inline Surface many_spheres(int count) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> at(-5, 5);
  Surface all = sphere(2);
  for (int i = 1; i < count; ++i)
    all = both(all, stretched(sphere(2), {0.4, 0.4, 0.4}, {at(engine), at(engine), at(engine)}));
  return all;
}

inline Surface shaken(Surface s, double size) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> by(-size, size);
  for (Point& p : s.positions)
    for (double& x : p) x += by(engine);
  return s;
}

inline Surface turned_inside_out(Surface s) {
  for (auto& t : s.triangles) std::swap(t[1], t[2]);
  return mesh::from_triangles(s.positions, s.triangles);
}

inline Surface stool() {
  return of_cells(13, [](int i, int j, int k) {
    const bool leg = (i == 1 || i == 11) && (j == 1 || j == 11);
    const bool rung =
        k == 4 && ((i == 1 || i == 11) || (j == 1 || j == 11)) && i >= 1 && i <= 11 && j >= 1 && j <= 11;
    return k == 12 || leg || rung;
  });
}

/// Returns random cells. The result has many tunnels, and edges with four triangles.
inline Surface sponge() {
  std::mt19937_64 engine(11);
  std::vector<std::uint8_t> full(512);
  for (auto& cell : full) cell = engine() % 2;
  return of_cells(
      8, [&](int i, int j, int k) { return full[static_cast<std::size_t>(i + 8 * j + 64 * k)] != 0; });
}

inline Surface book() {
  return mesh::from_triangles({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0.3, 0}, {0.2, 1, 0.5}, {0, -1, 1}},
                              {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 5}});
}

struct NamedModel {
  std::string name;
  Surface surface;
};

/// Returns models with nonzero size: one of each difficult kind or, in a long run, all models.
inline std::vector<NamedModel> generated_models() {
  std::vector<NamedModel> all;
  const auto add = [&](std::string name, Surface surface) {
    all.push_back({std::move(name), std::move(surface)});
  };
  add("cube", cube());
  add("sphere", sphere(4));
  add("torus", torus(40, 20));
  add("open torus", torus(40, 20, true));
  add("sphere with handles", both(both(sphere(3), stretched(torus(30, 10), {0.3, 0.3, 0.3}, {1, 0, 0})),
                                  turned(stretched(torus(30, 10), {0.25, 0.25, 0.3}, {-0.8, 0.5, 0}), 1)));
  add("linked rings", both(torus(40, 12), stretched(turned(torus(40, 12), 1.5), {1, 1, 1}, {2, 0, 0})));
  add("stool", stool());
  add("sponge", sponge());
  add("plate", stretched(cube(), {1, 1, 1e-3}));
  add("turned plate", turned(stretched(cube(), {1, 0.7, 1e-3}), 0.6));
  add("two plates", both(stretched(cube(), {1, 1, 1e-3}), stretched(cube(), {1, 1, 1e-3}, {0, 0, 0.02})));
  add("rod", stretched(cube(), {1, 1e-3, 1e-3}));
  add("soup", soup(100, 0.1, 1));
  add("dense soup", soup(3000, 0.3, 2));
  add("forty parts", many_spheres(40));
  add("book", book());
  add("half sphere", without_lower_half(sphere(4)));
  add("sheet with holes", sheet(20, [](int i, int j) { return i % 5 == 2 && j % 4 == 1; }));
  add("points", points_only(soup(200, 0.1, 5).positions));
  add("two points", points_only({{0, 0, 0}, {1, 2, 3}}));
  add("points in a plane", points_only({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.2, 0}}));
  add("triangle", mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0.4}}, {{0, 1, 2}}));
  add("segment", mesh::from_triangles({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {{0, 1, 2}, {0, 2, 1}, {1, 1, 2}}));
  add("inside out", turned_inside_out(sphere(3)));
  add("every triangle twice", both(torus(30, 12), torus(30, 12)));
  add("a part within", both(sphere(3), stretched(turned_inside_out(sphere(3)), {0.8, 0.8, 0.8})));
  add("a part far away", both(sphere(3), stretched(sphere(2), {0.1, 0.1, 0.1}, {60, 20, 10})));
  add("unused vertices", [] {
    Surface s = sphere(3);
    s.positions.push_back({50, 40, 30});
    return s;
  }());
  add("nearly mirrored", shaken(stool(), 0.05));
  add("shaken sphere", shaken(sphere(4), 0.02));
  add("huge", moved(torus(30, 12), 1e50));
  add("tiny", moved(torus(30, 12), 1e-50));
  add("far away", moved(stool(), 1, 1e7));
  static const std::set<std::string> few = {"torus", "plate", "soup", "book", "points", "inside out"};
  if (rounds(1, 2) == 1)
    std::erase_if(all, [](const NamedModel& model) { return !few.contains(model.name); });
  return all;
}

}  // namespace viete::test
