// Tests the bundled dragon: its documented properties, and that the program can make it again.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

#include "dragon/model.h"
#include "dragon/splats.h"
#include "formats/read.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"
#include "mesh/summary.h"
#include "support/data.h"

namespace fs = std::filesystem;
using namespace viete;

namespace {

std::string bytes(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  REQUIRE_MESSAGE(stream.good(), path.string() << " cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

fs::path dragon_dir() {
  return test::assets_dir() / "dragon";
}

}  // namespace

TEST_CASE("generator_makes_the_committed_files_byte_for_byte") {
  const fs::path made = test::build_dir() / "dragon_made_again";
  fs::remove_all(made);
  fs::create_directories(made);
  dragon::write_files(made);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(made)) {
    CAPTURE(entry.path().filename().string());
    const bool same = bytes(entry.path()) == bytes(dragon_dir() / entry.path().filename());
    CHECK(same);
    ++files;
  }
  CHECK(files == 9);
}

TEST_CASE("splats_of_the_dragon_are_flat_along_its_surface_and_the_same_on_every_machine") {
  const mesh::Surface surface = formats::read(dragon_dir() / "dragon.ply").surface;
  dragon::Mesh model;
  for (const mesh::Point& p : surface.positions) model.positions.push_back({p[0], p[1], p[2]});
  model.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  const std::string file = dragon::splats_file(model, 2000, "2000 splats");
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const unsigned char c : file) hash = (hash ^ c) * 1099511628211U;
  CHECK(hash == 7000602057303952467U);
  const formats::ReadResult capture = formats::read(formats::Source{"capture.ply", "ply", file});
  REQUIRE(capture.splats);
  const mesh::Splats& splats = *capture.splats;
  CHECK(splats.size() == 2000);
  CHECK(splats.degree == 3);
  CHECK(capture.comments == std::vector<std::string>{"2000 splats"});
  const mesh::Bounds all = mesh::bounds(surface.positions), some = mesh::bounds(capture.surface.positions);
  std::vector<mesh::Vec3> normals(surface.positions.size());
  const auto around = mesh::vertex_triangles(normals.size(), surface.triangles);
  mesh::vertex_normals(surface.positions, surface.triangles, around, 0, normals.size(), normals);
  std::vector<std::uint32_t> vertices(normals.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  const mesh::PointTree tree(surface.positions, vertices);
  std::size_t along = 0, opaque = 0;
  for (std::size_t v = 0; v < splats.size(); ++v) {
    const auto [w, x, y, z] = splats.rotations[v];
    const double size = w * w + x * x + y * y + z * z;
    const mesh::Vec3 thin{2 * (x * z + w * y) / size, 2 * (y * z - w * x) / size,
                          1 - 2 * (x * x + y * y) / size};
    const std::uint32_t vertex = tree.nearest(capture.surface.positions[v]);
    CHECK(mesh::norm(surface.positions[vertex] - capture.surface.positions[v]) < 0.03);
    along += std::abs(mesh::dot(thin, normals[vertex])) > 0.8 ? 1 : 0;
    opaque += splats.opacities[v] > 2 ? 1 : 0;
    CHECK(splats.log_scales[v][2] < splats.log_scales[v][1] - 1);
  }
  CHECK(along > 1900);
  CHECK(opaque == 1920);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(some.low[k] == doctest::Approx(all.low[k]).epsilon(0.05).scale(1));
    CHECK(some.high[k] == doctest::Approx(all.high[k]).epsilon(0.05).scale(1));
  }
}

TEST_CASE("dragon_is_one_closed_oriented_part_of_genus_0_with_50000_vertices") {
  const mesh::Summary summary = mesh::summarize(formats::read(dragon_dir() / "dragon.ply").surface);
  CHECK(summary.vertices == 50000);
  CHECK(summary.triangles == 99996);  // 2 v - 4: Euler's formula for a sphere
  CHECK(summary.parts == 1);
  CHECK(summary.closed());
  CHECK(summary.manifold());
  CHECK(summary.oriented());
  CHECK(summary.unused_vertices.empty());
  CHECK(summary.degenerate_polygons.empty());
  CHECK(summary.volume > 0);
}

TEST_CASE("dragon_stands_on_the_ground_and_is_two_to_three_units_long") {
  const mesh::Bounds box = mesh::bounds(formats::read(dragon_dir() / "dragon.ply").surface.positions);
  CHECK(box.low[1] == doctest::Approx(0).epsilon(1e-6));
  CHECK(box.high[0] - box.low[0] > 2);
  CHECK(box.high[0] - box.low[0] < 3);
}

TEST_CASE("dragon_file_is_binary_and_below_2500000_bytes") {
  const std::string file = bytes(dragon_dir() / "dragon.ply");
  CHECK(file.size() < 2500000);
  CHECK(file.starts_with("ply\nformat binary_little_endian 1.0\n"));
}
