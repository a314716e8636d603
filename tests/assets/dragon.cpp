// Tests the bundled dragon: its documented properties, and that the program can make it again.
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "dragon/model.h"
#include "formats/read.h"
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
