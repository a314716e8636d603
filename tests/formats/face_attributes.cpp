// Reads, keeps and converts face colours and face texture coordinates.

#include "formats/write.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

std::vector<Color> face_colors(const std::string& bytes, const std::string& extension) {
  const ReadResult read = test::read_kept(bytes, extension);
  CHECK(test::written_again(read, read.surface.positions) == bytes);
  return read.attributes ? read.attributes->polygon_colors : std::vector<Color>();
}

ReadResult converted(const ReadResult& read, const std::filesystem::path& path, std::size_t notes = 0) {
  const Content content{read.surface, read.surface.positions, {}, read.attributes.get()};
  CHECK(formats::write(path, content, nullptr, {}).size() == notes);
  return formats::read(path);
}

// Two triangles with two common vertices. At these vertices, the triangles have different texture points.
const std::string wedges =
    "ply\nformat ascii 1.0\ncomment VCGLIB generated\ncomment TextureFile my wood.png\ncomment TextureFile "
    "b.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 3\nproperty "
    "list "
    "uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\nproperty uchar "
    "red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    "3 0 1 2 6 0 0 0.5 0 0.5 0.5 0 255 0 0 255\n"
    "2 0 1 0 0 9 9 9 9\n"
    "3 0 2 3 6 0 0 0.25 0.25 0 1 1 0 0 255 255\n";

}  // namespace

TEST_CASE("off_face_colours_may_be_bytes_fractions_or_missing") {
  const std::string head = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const auto bytes =
      face_colors(head + "3 0 2 1 255 0 51\n3 0 1 3\n2 0 1 9 9 9\n3 1 2 3 0 0 255 51 # last\n", "off");
  CHECK(bytes == std::vector<Color>{{1, 0, 0.2F, 1}, Material{}.base_color, {0, 0, 1, 0.2F}});
  CHECK(face_colors(head + "3 0 2 1 0.5 0 1\n3 0 1 3 7\n3 0 3 2 x\n3 1 2 3\n", "off").at(0) ==
        Color{0.5F, 0, 1, 1});
  CHECK(face_colors(head + "3 0 2 1 7\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", "off").empty());
}

TEST_CASE("colours_of_integers_and_of_decimals_are_scaled_separately") {
  const std::string head = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  CHECK(face_colors(head + "3 0 2 1 255 0 51\n3 0 1 3 1.0 0.5 0.0\n3 0 3 2 0 0 1 0.5\n3 1 2 3 0.25 0 1 255\n",
                    "off") ==
        std::vector<Color>{{1, 0, 0.2F, 1}, {1, 0.5F, 0, 1}, {0, 0, 1 / 255.0F, 0.5F}, {0.25F, 0, 1, 1}});
  CHECK(face_colors(head + "3 0 2 1 1 0 0\n3 0 1 3 1.0 0.5 0.0\n3 0 3 2 0 0 1\n3 1 2 3 127.5 0 0\n", "off") ==
        std::vector<Color>{{1, 0, 0, 1}, {1 / 255.0F, 0.5F / 255, 0, 1}, {0, 0, 1, 1}, {0.5F, 0, 0, 1}});
  const std::vector<Color> mixed = {{1, 0, 0, 1}, {0.5F, 0.5F, 0.5F, 1}, {0, 0.2F, 0, 1}};
  for (const std::string start : {"OFF", "COFF", "obj"}) {
    const bool obj = start == "obj";
    const std::string v = obj ? "v " : "";
    const ReadResult read =
        test::read_kept((obj ? "" : start + "\n3 1 0\n") + v + "0 0 0 255 0 0\n" + v + "1 0 0 0.5 0.5 0.5\n" +
                            v + "0 1 0 0 51 0\n" + (obj ? "f 1 2 3\n" : "3 0 1 2\n"),
                        obj ? "obj" : "off");
    REQUIRE(read.attributes);
    CHECK(read.attributes->colors == mixed);
  }
}

TEST_CASE("off_undeclared_colours_are_kept") {
  const test::TemporaryFolder folder;
  const std::string faces = "3 0 2 1 0 0 255\n3 0 1 2\n";
  const std::string text = "OFF\n3 2 0\n0 0 0 200 0 40 255\n1 0 0 51 0 255\n0 1 0\n" + faces;
  const ReadResult r = test::read_kept(text, "off");
  REQUIRE(r.attributes);
  CHECK(r.warnings.empty());
  CHECK(r.attributes->colors ==
        std::vector<Color>{{200 / 255.0F, 0, 40 / 255.0F, 1}, {0.2F, 0, 1, 1}, Material{}.base_color});
  CHECK(test::written_again(r, r.surface.positions) == text);
  const ReadResult ply = converted(r, folder / "a.ply");
  CHECK(ply.attributes->colors[0] == r.attributes->colors[0]);
  CHECK(ply.attributes->polygon_colors[0] == Color{0, 0, 1, 1});
  CHECK(converted(r, folder / "a.off").attributes->colors[0] == r.attributes->colors[0]);
  for (const char* row : {"0 0 -1", "1 2 3 4 5", "1 2", "red"}) {
    const ReadResult odd =
        test::read_text("OFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 " + std::string(row) + "\n0 1 0\n3 0 1 2\n", "off");
    CHECK(odd.attributes == nullptr);
    CHECK(mentions(odd.warnings.at(0), "ignored undeclared values after the positions of 1 vertex row"));
  }
}

TEST_CASE("face_colours_are_written_where_the_format_has_them") {
  const test::TemporaryFolder folder;
  const ReadResult off = test::read_kept(
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 0 255\n3 0 3 2 0 0 255\n3 1 2 3 "
      "255 "
      "0 0\n",
      "off");
  const auto& colors = off.attributes->polygon_colors;
  CHECK(converted(off, folder / "a.ply").attributes->polygon_colors == colors);
  CHECK(converted(off, folder / "a.off").attributes->polygon_colors == colors);
  const ReadResult glb = converted(off, folder / "a.glb");
  for (std::size_t p = 0; p < 4; ++p) CHECK(glb.surface.polygon_starts[p] == 3 * p);
  CHECK(glb.surface.positions.size() == 4);  // the reader joins vertices of different colours
  const std::string bytes = test::file_bytes(folder / "a.glb");
  CHECK(mentions(bytes, "COLOR_0"));
  CHECK(formats::write(folder / "b.stl",
                       Content{off.surface, off.surface.positions, {}, off.attributes.get()}, nullptr,
                       {}) == std::vector<std::string>{"left out of the STL file: colours of faces"});
}

TEST_CASE("ply_faces_have_texture_points_colours_and_images") {
  const test::TemporaryFolder folder;
  const ReadResult read = test::read_kept(wedges, "ply", folder.path());
  CHECK(test::written_again(read, read.surface.positions) == wedges);
  REQUIRE(read.attributes);
  const Attributes& a = *read.attributes;
  CHECK(a.texture_points.size() == 5);  // (0, 0) is stored only once
  const auto at = [](const Attributes& all, std::size_t c) {
    return all.texture_points[all.corner_texture[c]];
  };
  CHECK(at(a, 2) == Vec2{0.5, 0.5});
  CHECK(at(a, 4) == Vec2{0.25, 0.25});
  CHECK(a.polygon_colors == std::vector<Color>{{1, 0, 0, 1}, {0, 0, 1, 1}});
  REQUIRE(a.groups.size() == 2);
  REQUIRE(a.materials.size() == 2);
  CHECK(a.groups[1].first_polygon == 1);
  CHECK(a.images[a.materials[a.groups[0].material].base_color_image].path == folder / "my wood.png");
  CHECK(a.images[a.materials[a.groups[1].material].base_color_image].path == folder / "b.png");
  for (const std::string name : {"out.ply", "out.obj", "out.glb"}) {
    const std::size_t missing_images = 2, lost_colors = name == "out.obj" ? 1 : 0;
    const ReadResult out = converted(read, folder / name, missing_images + lost_colors);
    REQUIRE(out.surface.corners.size() == 6);
    for (std::size_t c = 0; c < 6; ++c) CHECK(at(*out.attributes, c) == at(a, c));
  }
  CHECK(formats::read(folder / "out.ply").attributes->polygon_colors == a.polygon_colors);
}

TEST_CASE("ply_names_of_images_have_no_blanks_around_them_and_any_length") {
  const std::string name = std::string(220, 'w') + " oak.png";
  std::string text = wedges;
  text.replace(text.find("my wood.png"), 11, "  \t" + name + "  \t\r");
  text.replace(text.find("comment VCGLIB generated\n"), 25, test::repeated("comment of many\n", 70));
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.ply", text);
  const ReadResult r = formats::read(folder / "a.ply");
  REQUIRE(r.attributes);
  REQUIRE(r.attributes->images.size() == 2);
  CHECK(r.attributes->images[0].path == folder / name);
  CHECK(r.attributes->images[1].path == folder / "b.png");
}

TEST_CASE("ply_face_texture_points_of_wrong_length_are_ignored") {
  std::string odd = wedges;
  odd.replace(odd.find("6 0 0 0.25 0.25 0 1"), 19, "4 0 0 0.25 0.25");
  const ReadResult read = test::read_kept(odd, "ply");
  CHECK(read.attributes->corner_texture[2] != none);
  CHECK(read.attributes->corner_texture[4] == none);
  CHECK(read.attributes->materials.empty());  // materials need the folder of the file
  CHECK(read.attributes->groups.empty());
}

TEST_CASE("ply_normals_of_several_face_elements_are_updated") {
  const std::string faces =
      "property list uchar int vertex_indices\nproperty float nx\nproperty float ny\nproperty "
      "float nz\n";
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\n" +
      faces + "element face 1\n" + faces +
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1 0 0 1\n3 0 1 2 0 0 1\n3 0 2 3 0 0 1\n";
  const ReadResult read = test::read_kept(text, "ply");
  CHECK(test::written_again(read, read.surface.positions) == text);
  auto moved = read.surface.positions;
  for (Point& p : moved) p = {p[0], -p[2], p[1]};
  const std::string written = test::written_again(read, moved);
  CHECK(mentions(written, "\n2 0 1 0 0 1\n3 0 1 2 0 -1 0\n3 0 2 3 0 -1 0\n"));
}
