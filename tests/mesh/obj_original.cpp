// OBJ files written again: nothing lost, nothing changed but what moved.
#include "mesh/formats/obj.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

const std::string rich =
    "# made by hand\r\n"
    "mtllib some.mtl\r\n"
    "o first thing\r\n"
    "v 0.000 0.000 0.000 1.0\r\n"
    "v 1.000 0.000 0.000 # here\r\n"
    "  v\t1.000  1.000 0.000\r\n"
    "V 0.000 1.000 0.000\r\n"
    "vt 0 0\r\nvt 1 0\r\nvt 1 1\r\n"
    "vp 0.5\r\n"
    "g left right\r\ns 1\r\nusemtl red paint\r\n"
    "f 1/1 2/2 \\\r\n3/3\r\n"
    "s off\r\nf -4/-3 -2 -1/1\r\n"
    "l 1 2 3\r\np 1 2\r\nnonsense 1 2 3\r\nf 1 2\r\n"
    "curv 0 1 1 2\r\n\r\n# end";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("obj_original_at_rest_is_the_very_file") {
  for (const std::string& text : {rich, replaced(rich, "# made", "\xEF\xBB\xBF# made"),
                                  std::string("v 1e-3 +2. .5\nv 1E5 0 -0\nv 1 1 1")}) {
    const ReadResult read = test::read_kept(text, "obj");
    CHECK(test::written_again(read, read.surface.positions) == text);
    for (const auto kind : {Digits::Kind::all, Digits::Kind::decimals})
      CHECK(test::written_again(read, read.surface.positions, {kind, 3}) == text);
  }
}

TEST_CASE("obj_original_changes_only_the_coordinates_that_moved") {
  const ReadResult read = test::read_kept(rich, "obj");
  auto moved = read.surface.positions;
  moved[0][1] = 0.5;
  moved[2] = {-2.25, 1, 1e-9};
  const std::string expected =
      replaced(replaced(rich, "v 0.000 0.000 0.000 1.0", "v 0.000 0.50000 0.000 1.0"), "1.000  1.000 0.000",
               "-2.25000  1.000 0.000");
  CHECK(test::written_again(read, moved, {Digits::Kind::decimals, 5}) == expected);
}

TEST_CASE("obj_original_prints_as_the_file_does") {
  const auto moved_first = [](const std::string& text, double x, Digits digits = {}) {
    const ReadResult read = test::read_kept(text, "obj");
    auto moved = read.surface.positions;
    moved[0][0] = x;
    const std::string line = test::written_again(read, moved, digits);
    return line.substr(0, line.find('\n'));
  };
  const double third = 1.0 / 3;
  CHECK(moved_first("v 1.000000 2.000000 3.000000\nv 0.000000 0.000000 0.000000\n", third) ==
        "v 0.333333 2.000000 3.000000");
  CHECK(moved_first("v 1.00000000 2.00000000 3.00000000\n", -third) == "v -0.33333333 2.00000000 3.00000000");
  // Six digits of the model's size at least; zeros at the end where the file has them.
  CHECK(moved_first("v 1 2 3\nv 0 0 0\n", third) == "v 0.33333 2 3");
  CHECK(moved_first("v 1 2 3\nv 0 0 0\n", 0.5) == "v 0.5 2 3");
  CHECK(moved_first("v 1000.5 2 3\nv 0 0 0\n", third) == "v 0.33 2 3");
  CHECK(moved_first("v 1e-3 2e-3 3e-3\nv 0 0 0\n", third / 1000) == "v 0.00033333 2e-3 3e-3");
  CHECK(moved_first("v 1.0000000e+00 2.0e+00 3.0E+00\n", third) == "v 3.3333333E-01 2.0e+00 3.0E+00");
  CHECK(moved_first("v 1.0 2.0 3.0\n", third, {Digits::Kind::all}) == "v 0.3333333333333333 2.0 3.0");
  CHECK(moved_first("v 1.0 2.0 3.0\n", 2, {Digits::Kind::decimals, 4}) == "v 2.0000 2.0 3.0");
  CHECK(moved_first("v 1 2 3\nv 0 0 0\n", 1e80) == "v 1e+80 2 3");
  CHECK(moved_first("v 0.1234567890123456789012 2 3\nv 0 0 0\n", 0.25) == "v 0.25 2 3");
}

TEST_CASE("obj_attributes_are_read") {
  const ReadResult read = test::read_kept(rich, "obj");
  REQUIRE(read.attributes);
  const Attributes& a = *read.attributes;
  CHECK(a.texture_points == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}});
  CHECK(a.corner_texture == std::vector<std::uint32_t>{0, 1, 2, 0, none, 0});
  CHECK(a.normals.empty());
  CHECK(a.corner_normal.empty());
  REQUIRE(a.groups.size() == 2);
  CHECK(a.groups[0].object == "first thing");
  CHECK(a.groups[0].name == "left right");
  CHECK(a.groups[0].smooth);
  CHECK(a.groups[1].first_polygon == 1);
  CHECK(!a.groups[1].smooth);
  REQUIRE(a.materials.size() == 1);
  CHECK(a.materials[0].name == "red paint");
  CHECK(a.groups[1].material == 0);
}

TEST_CASE("obj_vertex_colours_are_read_in_ones_and_in_bytes") {
  const auto colors = [](const std::string& text) { return test::read_kept(text, "obj").attributes->colors; };
  CHECK(colors("v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 0 0 1 0.5\nf 1 2 3\n") ==
        std::vector<Color>{{1, 1, 1, 1}, {1, 0.5F, 0, 1}, {0, 0, 1, 0.5F}});
  CHECK(colors("v 0 0 0 255 0 51\n") == std::vector<Color>{{1, 0, 0.2F, 1}});
  CHECK(test::read_kept("v 0 0 0 1.0\n", "obj").attributes == nullptr);
}

TEST_CASE("obj_indices_that_lead_nowhere_are_a_warning") {
  const ReadResult read = test::read_kept(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nvn 0 x 1\n"
      "f 1/1/1 2/2/-1 3/-2/-9\nf 1/1/1 2/1/1\nf 1//1 2/0/1 3/1/2/3\n",
      "obj");
  REQUIRE(read.attributes);
  CHECK(read.attributes->corner_texture == std::vector<std::uint32_t>{0, none, none, none, none, none});
  CHECK(read.attributes->corner_normal == std::vector<std::uint32_t>{0, 1, none, 0, none, none});
  CHECK(read.attributes->normals[1] == Vec3{0, 0, 0});
  REQUIRE(read.warnings.size() == 3);
  CHECK(
      holds(read.warnings[0], "5 references to texture coordinates or normals that the file does not have"));
  CHECK(holds(read.warnings[1], "1 line of texture coordinates or normals cannot be read"));
}

namespace {

// Two squares that meet at a right angle, with one normal each, and a third that bends upward.
const std::string folded =
    "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 1.0 1.0 0.0\nv 0.0 1.0 0.0\nv 0.0 0.0 1.0\nv 0.0 1.0 1.0\n"
    "vn 0.0000 0.0000 1.0000\nvn 1.0000 0.0000 0.0000\n# normals\ns 1\n"
    "f 1//1 2//1 3//1 4//1\nf 1//-1 4//-1 6//-1 5//-1\n";

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// Of each corner, as it is read again.
std::vector<Vec3> corner_normals(const std::string& text) {
  const ReadResult read = test::read_kept(text, "obj");
  std::vector<Vec3> normals;
  for (const std::uint32_t n : read.attributes->corner_normal) {
    REQUIRE(n != none);
    normals.push_back(read.attributes->normals[n]);
  }
  return normals;
}

}  // namespace

TEST_CASE("obj_normals_turn_with_a_rigid_motion_and_no_line_is_added") {
  const ReadResult read = test::read_kept(folded, "obj");
  auto moved = read.surface.positions;
  for (Point& p : moved) p = {-p[1] + 5, p[0], p[2]};
  const std::string written = test::written_again(read, moved);
  CHECK(count_of(written, "vn ") == 2);
  CHECK(holds(written, "vn 0.0000 0.0000 1.0000\nvn 0.0000 1.0000 0.0000\n# normals"));
  CHECK(holds(written, "f 1//-1 4//-1 6//-1 5//-1\n"));
}

TEST_CASE("obj_a_normal_that_serves_corners_which_now_differ_becomes_several") {
  for (const bool crlf : {false, true}) {
    std::string text;
    for (const char c : folded) text += crlf && c == '\n' ? "\r\n" : std::string(1, c);
    const ReadResult read = test::read_kept(text, "obj");
    auto moved = read.surface.positions;
    moved[2][2] = 0.5;  // the first square is bent; the second does not move
    const std::string written = test::written_again(read, moved);
    const std::string end = crlf ? "\r\n" : "\n";
    CHECK(count_of(written, "vn ") > 2);
    CHECK(holds(written, "vn 1.0000 0.0000 0.0000" + end + "vn "));
    CHECK(holds(written, end + "# normals" + end));
    const auto before = corner_normals(text), after = corner_normals(written);
    for (std::size_t c = 0; c < 4; ++c) {
      CHECK(after[c] != before[c]);
      CHECK(norm(after[c]) == doctest::Approx(1).epsilon(1e-4));
      CHECK(dot(after[c], before[c]) > 0.8);
      CHECK(after[c + 4] == before[c + 4]);
    }
    CHECK(after[2][2] < 0.99);
  }
}

TEST_CASE("obj_flat_faces_keep_one_normal_each") {
  const ReadResult read = test::read_kept(replaced(folded, "s 1", "s off"), "obj");
  auto moved = read.surface.positions;
  moved[2][2] = 0.5;
  const std::string written = test::written_again(read, moved);
  CHECK(count_of(written, "vn ") == 2);
  const auto after = corner_normals(written);
  for (std::size_t c = 0; c < 4; ++c) CHECK(after[c] == after[0]);
}

TEST_CASE("obj_normals_of_several_blocks_are_counted_on") {
  const std::string tail =
      "f -4//1 -3//1 -2//1\nf 1//2 2//2\nf -4//3 -1//-2 1//-3 2//3\nvn 0.6 0 0.8\nf 7//4 8//-1 9//4";
  const std::string text = folded + "v 9.0 0.0 0.0\nv 9.0 1.0 0.0\nv 9.0 0.0 1.0\nvn 0 1 0\n" + tail;
  const ReadResult read = test::read_kept(text, "obj");
  auto moved = read.surface.positions;
  moved[2][2] = 0.5;
  moved[0][0] = -0.5;
  const std::string written = test::written_again(read, moved);
  const auto before = corner_normals(text), after = corner_normals(written);
  REQUIRE(before.size() == after.size());
  for (std::size_t c = 0; c < before.size(); ++c) CHECK(dot(before[c], after[c]) > 0.7);
  CHECK(after.back() == before.back());
  CHECK(test::written_again(read, read.surface.positions) == text);
  // Of a face that is none, the second of the normals, behind those that were added.
  const std::string unmoved = "f 1//" + std::to_string(count_of(folded, "vn ")) + " 2//2\n";
  CHECK(holds(written, unmoved));
}

TEST_CASE("obj_a_normal_at_the_end_of_a_file_without_line_end_can_become_several") {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ns 1\nf 1//1 2//1 3//1 4//1\nvn 0 0 1";
  const ReadResult read = test::read_kept(text, "obj");
  auto moved = read.surface.positions;
  moved[2][2] = 0.5;
  const std::string written = test::written_again(read, moved);
  CHECK(corner_normals(written).size() == 4);
  CHECK(corner_normals(written)[1] != corner_normals(written)[3]);
}
