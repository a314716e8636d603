#include "mesh/formats/obj.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Surface surface_of(const std::string& text) {
  const ReadResult result = test::read_text(text, "obj");
  CHECK(result.format == "OBJ");
  test::check_invariants(result.surface);
  return result.surface;
}

}  // namespace

TEST_CASE("obj_vertices_keep_order_and_precision") {
  const Surface s = surface_of("v -0.1234567890123456 1e-300 3\nv 7 8 9\nf 1 2 1\n");
  CHECK(s.positions == std::vector<Point>{{-0.1234567890123456, 1e-300, 3}, {7, 8, 9}});
}

TEST_CASE("obj_faces_may_carry_texture_and_normal_indices_of_any_kind") {
  for (const char* face : {"f 1 2 3 4", "f 1/1 2/2 3/3 4/9999", "f 1//1 2//2 3//3 4//-1",
                           "f 1/1/1 2/2/2 3/3/3 4/4/4", "f -4 -3 -2 -1", "f -4/-1/-1 -3//2 3 4/1"}) {
    const Surface s = surface_of(four + face);
    CHECK(s.corners == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(s.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("obj_relative_indices_count_from_the_face_they_stand_in") {
  const Surface s = surface_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
  CHECK(s.triangles == std::vector<Triangle>{{0, 1, 2}, {3, 2, 1}});
}

TEST_CASE("obj_dialects_read_the_same") {
  const std::string plain = four + "f 1 2 3\nf 1 3 4\n";
  const Surface expected = surface_of(plain);
  std::string crlf, cr;
  for (const char c : plain) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  const std::string dialects[] = {
      crlf,
      cr,
      "\xEF\xBB\xBF" + plain,
      plain.substr(0, plain.size() - 1),
      "  \t# note\n\n" + plain + "\n\n# end",
      "v\t0 0\t0  \n v 1 0 0 0.5 0.5 0.5\nv 1 1 0 1\nv +0 1. .0\nf  1  2 3 # first\nf 1 \\\n3 \\\r\n4\n",
      "f 1 2 3\nf 1 3 4\n" + four,
      "mtllib a.mtl\no x\ng a b\ns off\nusemtl red\nvn 0 0 1\nvt 0 0\n" + plain + "l 1 2 3\np 1\n",
      "# " + std::string(1 << 20, 'x') + "\n" + plain,
  };
  for (const std::string& text : dialects) {
    const Surface s = surface_of(text);
    CHECK(s.positions == expected.positions);
    CHECK(s.triangles == expected.triangles);
  }
}

TEST_CASE("obj_errors_name_file_line_and_what_to_do") {
  CHECK(test::refusal(four + "f 1 2 5\n", "obj") ==
        "given.obj:5: face refers to vertex 5, the file has 4; export the model again");
  CHECK(test::refusal(four + "f -5 2 3\n", "obj") ==
        "given.obj:5: face refers to vertex -5, the file has 4 before it; export the model again");
  CHECK(holds(test::refusal(four + "f 0 1 2\n", "obj"),
              "given.obj:5: face refers to vertex 0, OBJ counts from 1"));
  CHECK(holds(test::refusal("v 0,5 0 0\n", "obj"),
              "given.obj:1: \"0,5\" is not a number; write decimals with a point"));
  CHECK(holds(test::refusal("v 1 2\n", "obj"), "given.obj:1: a coordinate is missing"));
  CHECK(holds(test::refusal("v 1 2 x\n", "obj"), "\"x\" is not a number"));
  CHECK(holds(test::refusal("v 1 2 nan\n", "obj"), "\"nan\" is not a finite number"));
  CHECK(holds(test::refusal(four + "f a b c\n", "obj"), "\"a\" is not a vertex index"));
  CHECK(holds(test::refusal(four + "f 1 2 3x\n", "obj"), "vertex index is followed by \"x\""));
  CHECK(holds(test::refusal(four + "f 1 2 3.5\n", "obj"), "followed by \".5\""));
  CHECK(holds(test::refusal(four + "f 1 2 99999999999\n", "obj"), "refers to vertex 99999999999"));
  CHECK(holds(test::refusal(four + "f 1 2 99999999999999999999\n", "obj"), "is too large"));
  CHECK(holds(test::refusal(four + "f 1 2 3\nf", "obj"), "given.obj:6: face without vertices"));
  CHECK(holds(test::refusal("f 1 2 3\n", "obj"), "the file has 0"));
  CHECK(holds(test::refusal("# nothing\n", "obj"), "no vertices found"));
}

TEST_CASE("obj_words_in_capitals_mean_the_same") {
  const ReadResult read =
      test::read_text("MTLLIB A\nV 0 0 0\nV 1 0 0\nv 1 1 0\nVN 0 0 1\nVt 0 0\nF 1 2 3\n", "obj");
  CHECK(read.surface.positions.size() == 3);
  CHECK(read.surface.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(read.warnings.empty());
}

TEST_CASE("obj_a_file_of_something_else_names_its_first_odd_line") {
  CHECK(test::refusal("# made by hand\n\nVERTEX 0 0 0\nVERTEX 1 0 0\n", "obj") ==
        "given.obj:3: OBJ has no lines that start with \"VERTEX\", and no vertices were found; export the "
        "model "
        "again");
  CHECK(holds(test::refusal("g a\nusemtl x\n", "obj"), "no vertices found"));
}

TEST_CASE("obj_lines_are_continued_however_the_backslash_stands") {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    for (const char* join : {"\\", " \\", "\\  ", " \\ \t "}) {
      const std::string next = join + std::string(end);
      std::string text;
      for (const std::string& line :
           {"v 0 0" + next + " 0", "v 1" + next + "0" + next + " 0", std::string("v 1 1 0"),
            "vn 0 0" + next + " 1", "g a b" + next + "c", "l 1 2" + next + "3",
            "# a path C:" + std::string(join), "f 1//1 2//1" + next + " 3//1"})
        text += line + end;
      const ReadResult r = test::read_kept(text, "obj");
      CHECK(r.warnings.empty());
      CHECK(r.surface.positions == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
      CHECK(r.surface.corners == std::vector<std::uint32_t>{0, 1, 2});
      REQUIRE(r.attributes);
      CHECK(r.attributes->groups.at(0).name == "a b");
      CHECK(test::written_again(r, r.surface.positions) == text);
      const std::string moved = test::written_again(r, {{0, 0, 0}, {1, 0, 0}, {1, 0, 5}});
      CHECK(test::read_text(moved, "obj").surface.positions[2] == Point{1, 0, 5});
      CHECK(test::read_text(moved, "obj").attributes->normals[0] == Vec3{0, -1, 0});
    }
  }
  CHECK(holds(test::refusal("v 0\\ \n0\\\r\n0\nv 0 0 x\n", "obj"), "given.obj:4:"));
}

TEST_CASE("obj_oddities_are_told_as_warnings") {
  const ReadResult points = test::read_text(four, "obj");
  REQUIRE(points.warnings.size() == 1);
  CHECK(points.warnings[0] == "given.obj: no faces, only a set of points");
  const ReadResult odd =
      test::read_text(four + "f 1 2\nf 1 2 3\nvertex 1\nvertex 2\nsurf 0 1 0 1 1 2\n", "obj");
  REQUIRE(odd.warnings.size() == 3);
  CHECK(odd.surface.polygon_count() == 1);
  CHECK(holds(odd.warnings[0], "1 free-form element cannot be shown"));
  CHECK(holds(odd.warnings[1], "given.obj:7: passed over 2 lines"));
  CHECK(holds(odd.warnings[2], "left out 1 face with fewer than three corners"));
}

TEST_CASE("obj_comments_of_the_head_are_kept") {
  const ReadResult r = test::read_text("# one\n#two\n\n##   three \nv 0 0 0\n# later\n", "obj");
  CHECK(r.comments == std::vector<std::string>{"one", "two", "three"});
  std::string many;
  for (int i = 0; i < 100; ++i) many.append("# ").append(300, 'x').append("\n");
  const ReadResult cut = test::read_text(many + "v 0 0 0\n", "obj");
  CHECK(cut.comments.size() == 64);
  CHECK(cut.comments[0].size() == 200);
}

TEST_CASE("obj_a_polygon_may_have_thousands_of_corners") {
  std::string text, face = "f";
  for (int i = 1; i <= 5000; ++i) {
    text.append("v ").append(std::to_string(i)).append(" 0 0\n");
    face.append(" ").append(std::to_string(i));
  }
  CHECK(surface_of(text + face).triangles.size() == 4998);
}
