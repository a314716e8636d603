// A workspace with a ball of 2,562 vertices as its model, and a larger ball as its cage.
#pragma once

#include <numbers>
#include <vector>

#include "support/shapes.h"
#include "workspace/workspace.h"

namespace viete::test {

inline mesh::Surface ball(double radius, int levels = 4) {
  constexpr double g = std::numbers::phi;
  std::vector<mesh::Point> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                     {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                     {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<mesh::Triangle> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (auto& p : points) p = (1 / norm(p)) * p;
  return moved(sphere_from(points, triangles, levels), radius);
}

inline workspace::Workspace ball_workspace(int levels = 4) {
  workspace::Workspace w;
  w.document = document::Document(document::generated_surface(ball(1, levels), "ball"));
  document::set_cage(w.document, document::generated_surface(ball(1.2, levels), "larger ball"));
  w.view.camera.viewport = {{1000, 800}, {200, 0}, {800, 780}};
  workspace::frame_all(w, false);
  return w;
}

}  // namespace viete::test
