// Reads real files, recognises them by their content, and writes them again.

#include "support/data.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
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

}  // namespace

TEST_CASE("every_shared_file_is_recognised_and_round_trips" * doctest::test_suite(test::if_present)) {
  const auto data = test::shared_data();
  if (data.empty()) return;
  const test::TemporaryFolder scratch;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const auto& path = entry.path();
    const Format* named = find_format(path);
    if (!entry.is_regular_file() || !named || !named->read || entry.file_size() > 20'000'000) continue;
    CAPTURE(path);
    const bool is_odd = path.parent_path().filename() == "bad";
    ReadResult read;
    try {
      read = formats::read(path);
    } catch (const std::exception& error) {
      CHECK_MESSAGE((is_odd || named->holds_morphs), error.what());
      continue;
    }
    ++files;
    const Format* found = format_of_content(path, Beginning(path));
    if (path.stem() != "obj_long_comment_line")  // Beginning is shorter than this line
      CHECK((found && found->name == format_of_description(read.format)->name));
    if (named->holds_morphs) continue;
    CHECK(test::written_again(read, read.surface.positions) == test::file_bytes(path));
    if (is_odd) continue;
    const auto moved = bent(read.surface);
    read.original->write_file(scratch / path.filename(), {read.surface, moved, {}}, {}, nullptr);
    const ReadResult again = formats::read(scratch / path.filename());
    CHECK(again.comments == read.comments);
    CHECK(again.surface.corners == read.surface.corners);
    CHECK(again.surface.polygon_starts == read.surface.polygon_starts);
    REQUIRE(bool(again.attributes) == bool(read.attributes));
    if (read.attributes) CHECK(again.attributes->corner_texture == read.attributes->corner_texture);
    double furthest = 0;
    for (std::size_t v = 0; v < moved.size(); ++v)
      furthest = std::max(furthest, norm(again.surface.positions[v] - moved[v]));
    CHECK(furthest <= 1e-5 * bounds(moved).diagonal());
  }
  CHECK(files > 0);
}
