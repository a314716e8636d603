// Files of a cube, of a cage around the cube, and of a pose of the cage.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <utility>

#include "formats/point_cache.h"
#include "formats/write.h"
#include "support/cube.h"
#include "support/folder.h"
#include "support/open.h"

namespace viete::test {

struct CubeFiles : TemporaryFolder {
  std::filesystem::path model = *this / "model.obj", cage = *this / "cage.obj", pose = *this / "pose.obj",
                        broken = *this / "broken.obj";

  CubeFiles() {
    formats::write(model, subdivided_cube());
    formats::write(cage, cube(1.5));
    formats::write(pose, cube(2));
    put_file(broken, "v 0 0 0\nf 1 2 3\n");
  }

  // Returns a cube with an additional vertex in each triangle, so that it has more vertices than the cage.
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

/// Writes a point cache. The file extension selects the format.
inline void write_cache(const std::filesystem::path& file,
                        const std::vector<std::vector<mesh::Point>>& frames, double rate = 1) {
  formats::PointCacheHead head{*formats::point_cache_format(file), frames.front().size(), frames.size(), 1,
                               1};
  for (std::size_t i = 0; i < frames.size(); ++i)
    head.seconds.push_back(static_cast<float>(static_cast<double>(i) / rate));
  std::vector<float> numbers;
  formats::write_point_cache(file, head, [&](std::size_t i) {
    numbers.clear();
    for (const mesh::Point& p : frames[i])
      for (const double x : p) numbers.push_back(static_cast<float>(x));
    return std::span<const float>(numbers);
  });
}

// Opens a session, or a model and its cage.
inline workspace::Workspace opened(std::vector<std::filesystem::path> files) {
  workspace::Workspace workspace;
  REQUIRE(open_now(workspace, {files::OpenRequest::What::model, std::move(files)}));
  return workspace;
}

}  // namespace viete::test
