// Cubes as files: a model, a cage around it and a pose; and helpers to open them.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "base/error.h"
#include "mesh/formats/write.h"
#include "scene/cube.h"
#include "scene/workspace/apply_opened.h"
#include "support/folder.h"

namespace viete::test {

struct CubeFiles : TemporaryFolder {
  std::filesystem::path model = *this / "model.obj", cage = *this / "cage.obj", pose = *this / "pose.obj",
                        broken = *this / "broken.obj";

  CubeFiles() {
    mesh::write(model, subdivided_cube());
    mesh::write(cage, cube(1.5));
    mesh::write(pose, cube(2));
    put_file(broken, "v 0 0 0\nf 1 2 3\n");
  }

  // With the center of every face, so that the model has more vertices than the cage.
  static mesh::Surface subdivided_cube() {
    mesh::Surface surface = cube(1);
    std::vector<mesh::Triangle> triangles;
    for (const auto& [a, b, c] : surface.triangles) {
      const auto& p = surface.positions;
      const auto middle = static_cast<std::uint32_t>(p.size());
      mesh::Point center;
      for (int k = 0; k < 3; ++k) center[k] = (p[a][k] + p[b][k] + p[c][k]) / 3;
      surface.positions.push_back(center);
      triangles.insert(triangles.end(), {{a, b, middle}, {b, c, middle}, {c, a, middle}});
    }
    return mesh::from_triangles(std::move(surface.positions), triangles);
  }
};

// A session, or a model with its cage.
inline scene::Workspace opened(std::vector<std::filesystem::path> files) {
  scene::Workspace workspace;
  REQUIRE(scene::open_now(workspace, {scene::OpenRequest::What::model, std::move(files)}));
  return workspace;
}

// The error message of a step; empty: none.
std::string problem_of(const auto& step) {
  try {
    step();
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace viete::test
