// A workspace with a ball of 2,562 vertices as its model, and a larger ball as its cage.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "workspace/workspace.h"

namespace viete::test {

inline mesh::Surface ball(double radius, int levels = 4) {
  constexpr double g = std::numbers::phi;
  std::vector<mesh::Point> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                     {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                     {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<mesh::Triangle> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (added)
        points.push_back(
            {points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2]});
      return at->second;
    };
    std::vector<mesh::Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
    for (auto& p : points) {
      const double length = std::hypot(p[0], p[1], p[2]);
      for (double& x : p) x *= radius / length;
    }
  }
  return mesh::from_triangles(std::move(points), triangles);
}

inline workspace::Workspace ball_workspace(int levels = 4) {
  workspace::Workspace w;
  w.document = document::document_of(document::generated_surface(ball(1, levels), "ball"));
  document::set_cage(w.document, document::generated_surface(ball(1.2, levels), "larger ball"));
  w.viewport = {{1000, 800}, {200, 0}, {800, 780}};
  workspace::frame_all(w, false);
  return w;
}

}  // namespace viete::test
