#include "formats/obj_file.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Surface surface_of(const std::string& text) {
  const ReadResult result = test::read_text(text, "obj");
  CHECK(result.format == "OBJ");
  test::check_invariants(result.surface);
  return result.surface;
}

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

// Two squares at a right angle, with one normal each.
const std::string folded =
    "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 1.0 1.0 0.0\nv 0.0 1.0 0.0\nv 0.0 0.0 1.0\nv 0.0 1.0 1.0\n"
    "vn 0.0000 0.0000 1.0000\nvn 1.0000 0.0000 0.0000\n# normals\ns 1\n"
    "f 1//1 2//1 3//1 4//1\nf 1//-1 4//-1 6//-1 5//-1\n";

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// Returns the normal of each corner of the OBJ text.
std::vector<Vec3> corner_normals(const std::string& text) {
  const ReadResult read = test::read_kept(text, "obj");
  std::vector<Vec3> normals;
  for (const std::uint32_t n : read.attributes->corner_normal) {
    REQUIRE(n != none);
    normals.push_back(read.attributes->normals[n]);
  }
  return normals;
}

std::vector<MtlMaterial> materials_of(const std::string& text) {
  return read_mtl(Source{"given.mtl", "mtl", text, nullptr, nullptr, "/models"});
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";

}  // namespace

TEST_CASE("obj_faces_may_carry_texture_and_normal_indices_of_any_kind") {
  for (const char* face : {"f 1 2 3 4", "f 1/1 2/2 3/3 4/9999", "f 1//1 2//2 3//3 4//-1",
                           "f 1/1/1 2/2/2 3/3/3 4/4/4", "f -4 -3 -2 -1", "f -4/-1/-1 -3//2 3 4/1"}) {
    const Surface s = surface_of(four + face);
    CHECK(s.corners == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(s.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  }
}

TEST_CASE("obj_relative_indices_refer_to_their_line") {
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
        "given.obj:5: face refers to vertex -5, the file has 4 vertices before this line; export the model "
        "again");
  test::check_refusals(
      "obj", {{four + "f 0 1 2\n", "given.obj:5: face refers to vertex 0, but OBJ indices start at 1"},
              {"v 0,5 0 0\n", "given.obj:1: \"0,5\" is not a number; use a decimal point"},
              {"v 1 2\n", "given.obj:1: a coordinate is missing"},
              {"v 1 2 x\n", "\"x\" is not a number"},
              {"v 1 2 nan\n", "\"nan\" is not a finite number"},
              {four + "f a b c\n", "\"a\" is not a vertex index"},
              {four + "f 1 2 3x\n", "vertex index is followed by \"x\""},
              {four + "f 1 2 3.5\n", "followed by \".5\""},
              {four + "f 1 2 99999999999\n", "refers to vertex 99999999999"},
              {four + "f 1 2 99999999999999999999\n", "is too large"},
              {four + "f 1 2 3\nf", "given.obj:6: the face has no vertices"},
              {"f 1 2 3\n", "the file has 0"},
              {"# nothing\n", "no vertices found"}});
  CHECK(test::refusal("# made by hand\n\nVERTEX 0 0 0\nVERTEX 1 0 0\n", "obj") ==
        "given.obj:3: unknown OBJ keyword \"VERTEX\", and no vertices were found; export the model again");
}

TEST_CASE("obj_continued_lines_accept_any_backslash_position") {
  for (const char* end : {"\n", "\r\n", "\r"})
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
  CHECK(mentions(test::refusal("v 0\\ \n0\\\r\n0\nv 0 0 x\n", "obj"), "given.obj:4:"));
}

TEST_CASE("obj_oddities_cause_warnings") {
  const ReadResult points = test::read_text(four, "obj");
  REQUIRE(points.warnings.size() == 1);
  CHECK(points.warnings[0] == "given.obj: the file has no faces, only a set of points");
  const ReadResult odd =
      test::read_text(four + "f 1 2\nf 1 2 3\nvertex 1\nvertex 2\nsurf 0 1 0 1 1 2\n", "obj");
  REQUIRE(odd.warnings.size() == 3);
  CHECK(odd.surface.polygon_count() == 1);
  CHECK(mentions(odd.warnings[0], "1 free-form element cannot be shown"));
  CHECK(mentions(odd.warnings[1], "given.obj:7: ignored 2 lines"));
  CHECK(mentions(odd.warnings[2], "ignored 1 face with fewer than three corners"));
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

TEST_CASE("obj_original_at_rest_is_identical") {
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
  // A number as large as the model has at least six significant digits. Trailing zeros are as in the file.
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

TEST_CASE("obj_vertex_colours_may_be_fractions_or_bytes") {
  const auto colors = [](const std::string& text) { return test::read_kept(text, "obj").attributes->colors; };
  CHECK(colors("v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 0 0 1 0.5\nf 1 2 3\n") ==
        std::vector<Color>{{1, 1, 1, 1}, {1, 0.5F, 0, 1}, {0, 0, 1, 0.5F}});
  CHECK(colors("v 0 0 0 255 0 51\n") == std::vector<Color>{{1, 0, 0.2F, 1}});
  CHECK(test::read_kept("v 0 0 0 1.0\n", "obj").attributes == nullptr);
}

TEST_CASE("obj_invalid_attribute_indices_cause_a_warning") {
  const ReadResult read = test::read_kept(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nvn 0 x 1\n"
      "f 1/1/1 2/2/-1 3/-2/-9\nf 1/1/1 2/1/1\nf 1//1 2/0/1 3/1/2/3\n",
      "obj");
  REQUIRE(read.attributes);
  CHECK(read.attributes->corner_texture == std::vector<std::uint32_t>{0, none, none, none, none, none});
  CHECK(read.attributes->corner_normal == std::vector<std::uint32_t>{0, 1, none, 0, none, none});
  CHECK(read.attributes->normals[1] == Vec3{0, 0, 0});
  REQUIRE(read.warnings.size() == 3);
  CHECK(mentions(read.warnings[0], "5 references to missing texture coordinates or normals"));
  CHECK(mentions(read.warnings[1], "used 0 for 1 unreadable line of texture coordinates"));
}

TEST_CASE("obj_normals_turn_with_a_rigid_motion_and_no_line_is_added") {
  const ReadResult read = test::read_kept(folded, "obj");
  auto moved = read.surface.positions;
  for (Point& p : moved) p = {-p[1] + 5, p[0], p[2]};
  const std::string written = test::written_again(read, moved);
  CHECK(count_of(written, "vn ") == 2);
  CHECK(mentions(written, "vn 0.0000 0.0000 1.0000\nvn 0.0000 1.0000 0.0000\n# normals"));
  CHECK(mentions(written, "f 1//-1 4//-1 6//-1 5//-1\n"));
}

TEST_CASE("obj_shared_normal_is_split_where_corners_differ") {
  for (const bool crlf : {false, true}) {
    std::string text;
    for (const char c : folded) text += crlf && c == '\n' ? "\r\n" : std::string(1, c);
    const ReadResult read = test::read_kept(text, "obj");
    auto moved = read.surface.positions;
    moved[2][2] = 0.5;  // bends the first square; the second square does not move
    const std::string written = test::written_again(read, moved);
    const std::string end = crlf ? "\r\n" : "\n";
    CHECK(count_of(written, "vn ") > 2);
    CHECK(mentions(written, "vn 1.0000 0.0000 0.0000" + end + "vn "));
    CHECK(mentions(written, end + "# normals" + end));
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

TEST_CASE("obj_normal_indices_continue_across_blocks") {
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
  // The face with only two corners still refers to the second normal of `folded`.
  const std::string unmoved = "f 1//" + std::to_string(count_of(folded, "vn ")) + " 2//2\n";
  CHECK(mentions(written, unmoved));
}

TEST_CASE("obj_normal_on_an_unterminated_last_line_can_be_split") {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ns 1\nf 1//1 2//1 3//1 4//1\nvn 0 0 1";
  const ReadResult read = test::read_kept(text, "obj");
  auto moved = read.surface.positions;
  moved[2][2] = 0.5;
  const std::string written = test::written_again(read, moved);
  CHECK(corner_normals(written).size() == 4);
  CHECK(corner_normals(written)[1] != corner_normals(written)[3]);
}

TEST_CASE("mtl_colours_opacity_and_images_are_read") {
  const auto all = materials_of(
      "# made up\r\nKd 1 1 1\r\nnewmtl red one\r\nKa 1 1 1\r\nKd 1 0.5 0\r\nd 0.25\r\nmap_Kd red.png\r\n"
      "newmtl grey\nKd 0.5\nTr 0.25\nmap_Kd -s 2 2 -o 0.5 -blendu off -clamp on -bm 1 sub\\my picture.jpg\n"
      "newmtl odd\nKd red green\nd x\nmap_Kd\nKd 2 -1 0.5\nnewmtl\n");
  REQUIRE(all.size() == 4);
  CHECK(all[0].material.name == "red one");
  CHECK(all[0].material.base_color == Color{1, 0.5F, 0, 0.25F});
  CHECK(all[0].maps.at(all[0].material.base_color_image) == "/models/red.png");
  CHECK(all[0].material.repeats);
  CHECK(all[1].material.base_color == Color{0.5F, 0.5F, 0.5F, 0.75F});
  CHECK(all[1].maps.at(all[1].material.base_color_image) == "/models/sub/my picture.jpg");
  CHECK(!all[1].material.repeats);
  CHECK(all[2].material.base_color == Color{1, 0, 0.5F, 1});
  CHECK(all[2].material.base_color_image == mesh::none);
}

TEST_CASE("mtl_metallic_roughness_emission_and_their_maps_are_read") {
  const auto all = materials_of(
      "newmtl a\nNs 250\nPm 0.25\nKe 0.5 0 1\nmap_Bump -bm 2 bumps.png\nnorm n.png\nmap_Ke e.png\nmap_Ks "
      "s.png\n"
      "newmtl b\nPr 0.75\nNs 1000\nmap_Pm -imfchan b mr.png\nmap_Kd c.png\nmap_d c.png\n"
      "newmtl c\nPr 2\nmap_Pr r.png\nmap_d o.png\ndisp d.png\n");
  REQUIRE(all.size() == 3);
  const Material &a = all[0].material, &b = all[1].material, &c = all[2].material;
  CHECK(a.roughness == 0.5F);
  CHECK(a.metallic == 0.25F);
  CHECK(a.emission == Color{0.5F, 0, 1, 1});
  CHECK(all[0].maps.at(a.normal_image) == "/models/n.png");
  CHECK(all[0].maps.at(a.emission_image) == "/models/e.png");
  CHECK(all[0].ignored == std::set<std::string>{"map_Ks"});
  CHECK(b.roughness == 0.75F);
  CHECK(b.metallic == 1);  // the image alone
  CHECK(all[1].maps.at(b.metallic_image) == "/models/mr.png");
  CHECK(b.is_translucent);
  CHECK(all[1].ignored.empty());
  CHECK(c.roughness == 1);
  CHECK(all[2].maps.at(c.roughness_image) == "/models/r.png");
  CHECK(!c.is_translucent);
  CHECK(all[2].ignored == std::set<std::string>{"disp", "map_d"});
}

TEST_CASE("missing_or_invalid_libraries_cause_a_warning") {
  const test::TemporaryFolder folder;
  for (const char* name : {"none.mtl", ".", "/", "a b c.mtl"}) {
    const ReadResult read =
        test::read_kept("mtllib " + std::string(name) + "\n" + triangle, "obj", folder.path());
    REQUIRE(!read.warnings.empty());
    CHECK(mentions(read.warnings[0], "material library"));
    CHECK(read.attributes->materials[0].name == "red");
  }
}

TEST_CASE("libraries_are_found_by_names_with_blanks_and_by_several_names") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "my colours.mtl", "newmtl red\nKd 1 0 0\n");
  test::put_file(folder / "two.mtl", "newmtl red\nKd 0 1 0\n");
  const auto color = [&](const std::string& names) {
    const ReadResult read = test::read_kept("mtllib " + names + "\n" + triangle, "obj", folder.path());
    CHECK(read.warnings.empty());
    return read.attributes->materials[0].base_color;
  };
  CHECK(color("my colours.mtl") == Color{1, 0, 0, 1});
  CHECK(color("two.mtl two.mtl") == Color{0, 1, 0, 1});
  const ReadResult other = test::read_kept(
      "mtllib two.mtl\nusemtl green\n" + triangle + "usemtl green\nf 1 2 3\n", "obj", folder.path());
  REQUIRE(other.warnings.size() == 1);
  CHECK(mentions(other.warnings[0], "1 material not found"));
}
