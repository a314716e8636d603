#include "formats/codecs.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

const std::string body = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

}  // namespace

TEST_CASE("off_dialects_read_the_same") {
  const std::string dialects[] = {
      "OFF\n4 2 0\n" + body,
      "OFF 4 2 0\n" + body,
      "off\n4 2 0\n" + body,
      "OFF\r\n4 2\r\n" + body,
      "4 2 0\n" + body,
      "# head\nOFF # note\n\n4 2 5 # counts\n\n# points\n" + body,
      "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0 0 0 0 0\n0 1 0 0 0 0 0\n3 0 1 2 255 0 0\n4 0 1 2 "
      "3 0.5 0.5 0.5 1\n",
      "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n4 0 1 2 3",
  };
  for (const std::string& text : dialects) {
    const ReadResult r = test::read_text(text, "off");
    test::check_invariants(r.surface);
    CHECK(r.format == "OFF");
    CHECK(r.surface.positions == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(r.surface.corners == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 3});
  }
}

TEST_CASE("off_errors_name_the_line") {
  test::check_refusals(
      "off",
      {{"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n3 0 1 2\n",
        "given.off:7: face refers to vertex 4, the file has 4, counted from 0"},
       {"OFF\n2000000000 2000000000 0\n0 0 0\n", "given.off:2: 2000000000 vertices and"},
       {"OFF\n-4 2 0\n" + body, "number of vertices -4 is negative"},
       {"OFF\n4 3 0\n" + body + "    ", "the file ends before the last face"},
       {"OFF\n4 2 0\n0 0 0\n1 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "given.off:4: a coordinate is missing"},
       {"OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2\n", "the file ends before the last face"},
       {"4OFF\n4 2 0\n" + body, "positions must have three coordinates"},
       {"OFF BINARY\n4 2 0\n" + body, "binary OFF is not supported"},
       {"OFF\n", "the file ends before the number of vertices"},
       {"OFF\n0 0 0\n", "no vertices"}});
}

TEST_CASE("off_prefixes_are_known_in_any_order") {
  const std::string normals = "3 1 0\n0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n3 0 1 2\n";
  CHECK(test::read_text("NOFF\n" + normals, "off").attributes->normals[1] == Vec3{0, 1, 0});
  for (const std::string head : {"STCNOFF", "NCSTOFF", "CNSTOFF", "STNCOFF"}) {
    const ReadResult r =
        test::read_kept(head +
                            "\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0.5 0.25\n1 0 0 0 0.6 0.8 0 255 0 255 1 "
                            "0\n0 1 0 1 0 0 0 0 255 255 0 1\n3 0 1 2\n",
                        "off");
    REQUIRE(r.attributes);
    CHECK(r.attributes->normals[1] == Vec3{0, 0.6, 0.8});
    CHECK(r.attributes->colors == std::vector<Color>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
    CHECK(r.attributes->texture_points[0] == Vec2{0.5, 0.25});
  }
  for (const std::string head : {"XOFF", "COF", "OFFC"})
    CHECK_FALSE(looks_like_off(Source{"given", "off", head + "\n" + body}));
  for (const std::string head : {"4OFF", "nOFF", "STCN4nOFF", "C4OFF"})
    CHECK(mentions(test::refusal(head + "\n4 2 0\n" + body, "off"),
                   '"' + head + "\" is not supported: positions must have three coordinates"));
}

TEST_CASE("off_colours_before_normals_are_integers") {
  const std::string text =
      "NCOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 1 \n1 0 0 200 0 0 255 0 0.6 0.8 \n0 1 0 0 0 255 255 0 0 1 \n3 0 1 "
      "2\n";
  const ReadResult r = test::read_kept(text, "off");
  REQUIRE(r.attributes);
  CHECK(r.attributes->normals[1] == Vec3{0, 0.6, 0.8});
  CHECK(r.attributes->colors[2] == Color{0, 0, 1, 1});
  CHECK(test::written_again(r, r.surface.positions) == text);
  CHECK(mentions(test::written_again(r, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), "0 0 0 0 0 1 255 0 -1 0 \n"));
}

TEST_CASE("off_faces_may_continue_on_the_next_line_and_colours_end_with_theirs") {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  for (const std::string faces :
       {"3 0\n2\n1\n4 0 1\n2 3 255 0 0\n3\n0 1 2\n", "3 0 2 1 # a\n4\n\n0 1 2 3 255 0 0 # b\n3 0 1 2"}) {
    const std::string text = "OFF\n4 3 0\n" + vertices + faces;
    const ReadResult r = test::read_kept(text, "off");
    CHECK(r.surface.corners == std::vector<std::uint32_t>{0, 2, 1, 0, 1, 2, 3, 0, 1, 2});
    REQUIRE(r.attributes);
    CHECK(r.attributes->polygon_colors ==
          std::vector<Color>{Material{}.base_color, {1, 0, 0, 1}, Material{}.base_color});
    CHECK(test::written_again(r, r.surface.positions) == text);
    CHECK(mentions(test::written_again(r, {{0, 0, 0}, {1, 0, 0}, {7, 8, 9}, {0, 1, 0}}),
                   "7 8 9\n0 1 0\n" + faces));
  }
}
