#include "mesh/ply.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

const std::string vertices4 = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces2 = "element face 2\nproperty list uchar int vertex_indices\n";
const std::string rows4 = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string ascii(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

// Builds binary bodies of either byte order.
struct Bytes {
  bool big = false;
  std::string text;

  template <class T>
  Bytes& put(T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (big != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    text.append(raw.data(), raw.size());
    return *this;
  }
};

std::string binary(const std::string& elements, const Bytes& body) {
  return std::string("ply\nformat binary_") + (body.big ? "big" : "little") + "_endian 1.0\n" + elements +
         "end_header\n" + body.text;
}

}  // namespace

TEST_CASE("ply_text_reads_vertices_and_polygons") {
  const ReadResult r = test::read_text(
      ascii("comment made by hand\n" + vertices4 + faces2, rows4 + "3 0 1 2\n4 0 1 2 3\n"), "ply");
  test::check_invariants(r.surface);
  CHECK(r.format == "PLY ascii");
  CHECK(r.comments == std::vector<std::string>{"made by hand"});
  CHECK(r.warnings.empty());
  CHECK(r.surface.positions[2] == Point{1, 1, 0});
  CHECK(r.surface.corners == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 3});
  CHECK(r.surface.triangles.size() == 3);
}

TEST_CASE("ply_binary_reads_every_type_in_both_byte_orders_among_other_elements_and_properties") {
  for (const bool big : {false, true}) {
    Bytes b{big, {}};
    const std::string elements =
        "element camera 1\nproperty double f\nproperty list short float d\n"
        "element vertex 3\nproperty uchar red\nproperty double z\nproperty list uint16 int8 extra\nproperty "
        "float32 x\nproperty short y\n"
        "element face 2\nproperty int8 flag\nproperty list int32 uint16 vertex_index\nproperty float64 area\n"
        "element edge 1\nproperty int a\nproperty int b\n";
    b.put(3.5).put(std::int16_t{2}).put(1.0f).put(2.0f);
    for (int i = 0; i < 3; ++i) {
      b.put(std::uint8_t{200})
          .put(0.1 * i)
          .put(std::uint16_t{1})
          .put(std::int8_t{-1})
          .put(float(i) + 0.5f)
          .put(std::int16_t(-300 * i));
    }
    b.put(std::int8_t{-1})
        .put(std::int32_t{3})
        .put(std::uint16_t{0})
        .put(std::uint16_t{1})
        .put(std::uint16_t{2})
        .put(0.5);
    b.put(std::int8_t{-1})
        .put(std::int32_t{3})
        .put(std::uint16_t{2})
        .put(std::uint16_t{1})
        .put(std::uint16_t{0})
        .put(0.5);
    b.put(std::int32_t{0}).put(std::int32_t{1});
    const ReadResult r = test::read_text(binary(elements, b), "ply");
    CHECK(r.format == (big ? "PLY binary big-endian" : "PLY binary little-endian"));
    CHECK(r.surface.positions == std::vector<Point>{{0.5, 0, 0}, {1.5, -300, 0.1}, {2.5, -600, 0.2}});
    CHECK(r.surface.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}});
  }
}

TEST_CASE("ply_triangle_strips_alternate_and_restart") {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const ReadResult r = test::read_text(ascii(vertices4 + strips, rows4 + "9 0 1 3 2 -1 0 1 2 2\n"), "ply");
  CHECK(r.surface.triangles == std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}, {0, 1, 2}});
}

TEST_CASE("ply_may_begin_with_a_byte_order_mark_whether_text_or_binary") {
  Bytes b;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) b.put(x);
  const std::string triangle = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  for (const std::string& file : {ascii(triangle, "0 0 0\n1 0 0\n0 1 0\n"), binary(triangle, b)}) {
    const ReadResult r = test::read_text("\xEF\xBB\xBF" + file, "ply");
    CHECK(r.surface.positions == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  }
}

TEST_CASE("ply_sizes_are_not_believed") {
  const std::string many =
      "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
  CHECK(holds(test::refusal(ascii(many, rows4), "ply"),
              "announces 4000000000 elements \"vertex\", the file has room for"));
  CHECK(holds(test::refusal(binary(many, Bytes{false, rows4}), "ply"), "announces 4000000000"));
  CHECK(holds(test::refusal(ascii("element vertex 9223372036854775807\nproperty float x\n", rows4), "ply"),
              "announces"));
  CHECK(holds(test::refusal(ascii("element vertex 99999999999999999999\n", ""), "ply"), "is too large"));
  CHECK(
      holds(test::refusal(ascii("element vertex\n", ""), "ply"), "given.ply:3: an element count is missing"));
  CHECK(holds(test::refusal(ascii("element vertex -3\n", ""), "ply"),
              "given.ply:3: element count -3 is negative"));
  CHECK(holds(test::refusal(ascii(vertices4 + faces2, rows4 + "2000000000 0 1 2\n3 0 1 2\n"), "ply"),
              "given.ply:14: a list announces 2000000000 values"));
  CHECK(holds(test::refusal(ascii(vertices4 + faces2, rows4 + "-3 0 1 2\n3 0 1 2\n"), "ply"),
              "announces -3 values"));
  CHECK(test::read_text(ascii("element nothing 4000000000\n" + vertices4, rows4), "ply")
            .surface.positions.size() == 4);
}

TEST_CASE("ply_errors_name_line_or_element") {
  CHECK(holds(test::refusal(ascii(vertices4 + faces2, rows4 + "3 0 1 2\n3 0 1 4\n"), "ply"),
              "given.ply:15: face refers to vertex 4 (from 0), the file has 4"));
  CHECK(holds(test::refusal(ascii(vertices4 + faces2, rows4 + "3 0 1 2\n3 0 1 -1\n"), "ply"), "vertex -1"));
  CHECK(holds(test::refusal(ascii(vertices4, "0 0 0\n0 0 nan\n0 0 0\n0 0 0\n"), "ply"),
              "given.ply:9: coordinate \"nan\""));
  CHECK(holds(test::refusal(ascii(vertices4, "0 0 0 1\n0 0 0\n0 0 0\n0 0\n"), "ply"),
              "given.ply:8: more values than"));
  CHECK(holds(test::refusal(ascii(vertices4, "0 0 0\n0 0 0\n0 0 0\n0 0        \n"), "ply"),
              "the file ends before"));
  CHECK(holds(test::refusal(ascii("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"), "ply"),
              "lacks x, y or z"));
  CHECK(holds(test::refusal(ascii(vertices4 + "element face 1\nproperty int a\n", rows4 + "3\n"), "ply"),
              "has no list vertex_indices"));
  CHECK(holds(test::refusal(ascii("element vertex 1\nproperty quad x\n", "0\n"), "ply"),
              "given.ply:4: \"quad\" is not a PLY type"));
  CHECK(holds(test::refusal("ply\nformat binary_middle_endian 1.0\n", "ply"), "is not a PLY format"));
  CHECK(holds(test::refusal("ply\nformat ascii 1.0\nelement vertex 1\n", "ply"),
              "the file ends before the end of the PLY header"));
  CHECK(holds(test::refusal("ply\nnonsense\n", "ply"), "given.ply:2: a PLY header cannot hold \"nonsense\""));
  CHECK(holds(test::refusal("ply\nproperty float x\n", "ply"), "before the first element"));
  CHECK(holds(test::refusal(ascii("", ""), "ply"), "no vertices"));
  Bytes b;
  for (int i = 0; i < 12; ++i) b.put(i == 7 ? NAN : 0.0f);
  CHECK(holds(test::refusal(binary(vertices4, b), "ply"),
              "given.ply: vertex 2: a coordinate is not a finite number"));
  Bytes cut;
  for (int i = 0; i < 12; ++i) cut.put(0.0f);
  cut.put(std::uint8_t{3}).put(0).put(1).put(2).put(std::uint8_t{3}).put(0);
  CHECK(holds(test::refusal(binary(vertices4 + faces2, cut), "ply"),
              "given.ply: face 1: a list announces 3 values"));
}

TEST_CASE("ply_points_are_read_with_a_warning") {
  const ReadResult r = test::read_text(ascii(vertices4, rows4), "ply");
  CHECK(r.surface.positions.size() == 4);
  REQUIRE(r.warnings.size() == 1);
  CHECK(holds(r.warnings[0], "only a set of points"));
}

TEST_CASE("ply_written_polygons_of_more_than_255_corners_come_back") {
  Surface s;
  s.polygon_starts = {0, 300};
  for (std::uint32_t i = 0; i < 300; ++i) {
    s.positions.push_back({1.0 * i, 0, 0});
    s.corners.push_back(i);
  }
  fan_triangulate(s);
  CHECK(test::read_text(test::bytes_by(write_ply, s), "ply").surface.corners == s.corners);
}
