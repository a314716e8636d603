// Real files written again.
#include <doctest/doctest.h>

#include <cmath>

#include "mesh/shapes.h"
#include "support/data.h"

using namespace viete;
using namespace viete::mesh;

namespace {

std::vector<Point> bent(const Surface& s) {
  const double size = bounds(s.positions).diagonal();
  std::vector<Point> moved = s.positions;
  for (Point& p : moved) {
    const double angle = 0.7 * p[1] / size;
    p = {p[0] * std::cos(angle) - p[2] * std::sin(angle), p[1],
         p[0] * std::sin(angle) + p[2] * std::cos(angle)};
  }
  return moved;
}

double furthest(const std::vector<Point>& a, const std::vector<Point>& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, norm(a[v] - b[v]));
  return most;
}

// Everything except positions and normals must be equal.
void check_kept(const ReadResult& before, const ReadResult& after) {
  CHECK(after.format == before.format);
  CHECK(after.comments == before.comments);
  CHECK(after.warnings.size() == before.warnings.size());
  CHECK(after.surface.corners == before.surface.corners);
  CHECK(after.surface.polygon_starts == before.surface.polygon_starts);
  REQUIRE(bool(after.attributes) == bool(before.attributes));
  if (!before.attributes) return;
  CHECK(after.attributes->texture_points == before.attributes->texture_points);
  CHECK(after.attributes->corner_texture == before.attributes->corner_texture);
  CHECK(after.attributes->colors == before.attributes->colors);
  CHECK(after.attributes->groups.size() == before.attributes->groups.size());
  CHECK(after.attributes->materials.size() == before.attributes->materials.size());
}

void check_round_trip(const std::filesystem::path& path, const std::filesystem::path& scratch) {
  CAPTURE(path.string());
  const ReadResult read = mesh::read(path);
  REQUIRE(read.original);
  CHECK(test::written_again(read, read.surface.positions) == test::file_bytes(path));
  const auto moved = bent(read.surface);
  const auto out = scratch / path.filename();
  read.original->write_file(out, read.surface, moved, {}, nullptr);
  const ReadResult again = mesh::read(out);
  check_kept(read, again);
  CHECK(furthest(again.surface.positions, moved) <= 1e-5 * bounds(moved).diagonal());
}

void check_rest_if_it_loads(const std::filesystem::path& path) {
  CAPTURE(path.string());
  try {
    const ReadResult read = mesh::read(path);
    CHECK(test::written_again(read, read.surface.positions) == test::file_bytes(path));
  } catch (const base::Error&) {
    // Many of the files are invalid on purpose.
  }
}

}  // namespace

TEST_CASE("every_shared_file_round_trips" * doctest::test_suite(test::if_present)) {
  const auto data = test::shared_data();
  if (data.empty()) return;
  const test::TemporaryFolder scratch;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string extension = extension_of(entry.path());
    const bool surface = extension == "obj" || extension == "ply" || extension == "off" || extension == "stl";
    if (!surface || !entry.is_regular_file() || entry.file_size() > 20'000'000) continue;
    const bool is_odd = entry.path().parent_path().filename() == "bad";
    is_odd ? check_rest_if_it_loads(entry.path()) : check_round_trip(entry.path(), scratch.path());
    ++files;
  }
  CHECK(files > 0);
}
