// A workspace with a cube as its model, and a larger cube as its cage, made in memory.
#pragma once

#include <memory>

#include "workspace/workspace.h"

namespace viete::test {

inline mesh::Surface cube(double half) {
  std::vector<mesh::Point> points;
  for (int i = 0; i < 8; ++i)
    points.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  const std::vector<mesh::Triangle> triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                 {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                 {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh::from_triangles(std::move(points), triangles);
}

inline document::OpenedSurface surface_without_file(mesh::Surface surface) {
  document::OpenedSurface opened;
  opened.bounds = mesh::used_bounds(surface);
  opened.surface = std::make_shared<const mesh::Surface>(std::move(surface));
  return opened;
}

/// Replaces the cage, and puts it at rest.
inline void put_cage(document::Document& document, const mesh::Surface& surface) {
  auto cage = std::make_shared<const pose::Cage>(pose::make_cage(surface));
  document.replace_cage(surface_without_file(surface), cage, pose::rest_pose(*cage));
}

inline document::Document cube_document() {
  document::Document document(surface_without_file(cube(1)));
  put_cage(document, cube(1.5));
  return document;
}

inline workspace::Workspace cube_workspace() {
  workspace::Workspace workspace;
  workspace.document = cube_document();
  workspace.view.camera.viewport = {{1000, 800}, {200, 0}, {800, 780}};
  workspace::frame_all(workspace, false);
  return workspace;
}

}  // namespace viete::test
