#include "formats/codecs.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

const std::string vertices4 = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces2 = "element face 2\nproperty list uchar int vertex_indices\n";
const std::string rows4 = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string ascii(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

// Builds a binary body in either byte order.
struct Bytes {
  bool big = false;
  std::string text;

  template <class T>
  Bytes& put(T value) {
    test::append(text, value, big ? std::endian::big : std::endian::little);
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
      b.put(std::uint8_t{200}).put(0.1 * i).put(std::uint16_t{1}).put(std::int8_t{-1});
      b.put(float(i) + 0.5f).put(std::int16_t(-300 * i));
    }
    for (const int first : {0, 2}) {
      b.put(std::int8_t{-1}).put(std::int32_t{3});
      for (const int v : {first, 1, 2 - first}) b.put(static_cast<std::uint16_t>(v));
      b.put(0.5);
    }
    b.put(std::int32_t{0}).put(std::int32_t{1});
    const ReadResult r = test::read_text(binary(elements, b), "ply");
    CHECK(r.format == (big ? "PLY binary big-endian" : "PLY binary little-endian"));
    CHECK(r.surface.positions == std::vector<Point>{{0.5, 0, 0}, {1.5, -300, 0.1}, {2.5, -600, 0.2}});
    CHECK(r.surface.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}});
  }
}

TEST_CASE("ply_binary_triangles_are_the_same_read_at_once_or_row_by_row") {
  constexpr int count = 70'000;
  const auto read = [](bool by_rows, int last_corners, int last_vertex) {
    Bytes b;
    for (int i = 0; i < count; ++i) {
      for (const float x : {float(i), 0.1F * float(i % 7), -1.0F}) b.put(x);
      if (by_rows) b.put(std::uint8_t{0});
    }
    for (int i = 2; i < count; ++i) {
      const int corners = i + 1 < count ? 3 : last_corners;
      b.put(static_cast<std::uint8_t>(corners)).put(i - 2).put(i - 1).put(i + 1 < count ? i : last_vertex);
      if (corners == 4) b.put(0);
      if (by_rows) b.put(std::uint8_t{9});
    }
    const std::string n = std::to_string(count), faces = std::to_string(count - 2);
    const std::string vertices = "element vertex " + n +
                                 "\nproperty float x\nproperty float y\nproperty float z\n" +
                                 (by_rows ? "property list uchar uchar extra\n" : "");
    return binary(vertices + "element face " + faces + "\nproperty list uchar int vertex_indices\n" +
                      (by_rows ? "property uchar flag\n" : ""),
                  b);
  };
  for (const int corners : {3, 4}) {
    const Surface at_once = test::read_text(read(false, corners, 5), "ply").surface;
    const Surface by_rows = test::read_text(read(true, corners, 5), "ply").surface;
    test::check_invariants(at_once);
    CHECK(at_once.positions == by_rows.positions);
    CHECK(at_once.corners == by_rows.corners);
    CHECK(at_once.polygon_starts == by_rows.polygon_starts);
    CHECK(at_once.triangles == by_rows.triangles);
    CHECK(at_once.triangle_polygon == by_rows.triangle_polygon);
  }
  CHECK(mentions(test::refusal(read(false, 3, count), "ply"), "face refers to vertex 70000 (from 0)"));
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

TEST_CASE("ply_declared_sizes_are_checked") {
  const std::string many =
      "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n";
  test::check_refusals(
      "ply", {{ascii(many, rows4), "announces 4000000000 elements \"vertex\", the file has room for"},
              {binary(many, Bytes{false, rows4}), "announces 4000000000"},
              {ascii("element vertex 9223372036854775807\nproperty float x\n", rows4), "announces"},
              {ascii("element vertex 99999999999999999999\n", ""), "is too large"},
              {ascii("element vertex\n", ""), "given.ply:3: an element count is missing"},
              {ascii("element vertex -3\n", ""), "given.ply:3: element count -3 is negative"},
              {ascii(vertices4 + faces2, rows4 + "2000000000 0 1 2\n3 0 1 2\n"),
               "given.ply:14: a list announces 2000000000 values"},
              {ascii(vertices4 + faces2, rows4 + "-3 0 1 2\n3 0 1 2\n"), "announces -3 values"}});
  CHECK(test::read_text(ascii("element nothing 4000000000\n" + vertices4, rows4), "ply")
            .surface.positions.size() == 4);
}

TEST_CASE("ply_extra_header_lines_and_values_are_ignored_with_warnings") {
  const ReadResult r = test::read_text(ascii("made by hand\n" + vertices4 + "also this\n" + faces2,
                                             "0 0 0 7\n1 0 0\n1 1 0\n0 1 0 7 8\n3 0 1 2 9\n4 0 1 2 3\n"),
                                       "ply");
  CHECK(r.surface.corners == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 3});
  CHECK(r.surface.positions[1] == Point{1, 0, 0});
  REQUIRE(r.warnings.size() == 2);
  CHECK(mentions(r.warnings[0], "given.ply:3: ignored a header line that starts with \"made\""));
  CHECK_MESSAGE(
      mentions(r.warnings[1], "given.ply:12: ignored extra values after the header's properties in 3 rows"),
      r.warnings[1]);
  const std::string bytes =
      ascii(vertices4 + faces2, "0 0 0 7 #\n1 0 0\n1 1 0\n0 1 0 7 8\n3 0 1 2 9\n4 0 1 2 3\n");
  const ReadResult kept = test::read_kept(bytes, "ply");
  CHECK(test::written_again(kept, kept.surface.positions) == bytes);
  CHECK(mentions(test::written_again(kept, {{5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 2}}),
                 "5 0 0 7 #\n1 0 0\n1 1 0\n0 1 2 7 8\n3 0 1 2 9\n"));
}

TEST_CASE("ply_64_bit_integers_round_trip") {
  for (const bool big : {false, true}) {
    Bytes b{big, {}};
    const std::string elements =
        "element vertex 3\nproperty int64 x\nproperty long y\nproperty double z\nproperty uint64 id\n"
        "element face 1\nproperty list uint64 int64 vertex_indices\nproperty ulong a\n";
    for (std::int64_t v = 0; v < 3; ++v)
      b.put(v * v).put(std::int64_t{-5} * v).put(0.5).put(~std::uint64_t{0});
    b.put(std::uint64_t{3});
    for (const std::int64_t v : {2, 1, 0}) b.put(v);
    b.put(~std::uint64_t{0});
    const std::string bytes = binary(elements, b);
    const ReadResult r = test::read_kept(bytes, "ply");
    CHECK(r.surface.positions == std::vector<Point>{{0, 0, 0.5}, {1, -5, 0.5}, {4, -10, 0.5}});
    CHECK(r.surface.corners == std::vector<std::uint32_t>{2, 1, 0});
    CHECK(test::written_again(r, r.surface.positions) == bytes);
    std::vector<Point> moved = r.surface.positions;
    moved[1] = {-7, 1e18, 2};
    const std::string written = test::written_again(r, moved);
    CHECK(test::read_text(written, "ply").surface.positions == moved);
    moved[1][0] = 9.3e18;
    CHECK_THROWS_AS(test::written_again(r, moved), base::Error);
  }
  const std::string text = ascii(
      "element vertex 3\nproperty int64 x\nproperty float y\nproperty float z\nproperty int64 id\n"
      "element face 1\nproperty list uint8 uint64 vertex_indices\n",
      "0 0 0 18446744073709551615\n1 0 0 7\n0 1 0 8\n3 0 1 2\n");
  const ReadResult r = test::read_kept(text, "ply");
  CHECK(r.surface.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(test::written_again(r, r.surface.positions) == text);
  CHECK(mentions(test::written_again(r, {{0, 0, 0}, {-6e18, 0, 0}, {0, 1, 0}}),
                 "\n-6000000000000000000 0 0 7\n"));
}

TEST_CASE("ply_errors_name_line_or_element") {
  test::check_refusals(
      "ply",
      {{ascii(vertices4 + faces2, rows4 + "3 0 1 2\n3 0 1 4\n"),
        "given.ply:15: face refers to vertex 4 (from 0), the file has 4"},
       {ascii(vertices4 + faces2, rows4 + "3 0 1 2\n3 0 1 -1\n"), "vertex -1"},
       {ascii(vertices4, "0 0 0\n0 0 nan\n0 0 0\n0 0 0\n"), "given.ply:9: coordinate \"nan\""},
       {ascii(vertices4, "0 0 0\n0 0 0\n0 0 0\n0 0        \n"), "the file ends before"},
       {ascii("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"), "lacks x, y or z"},
       {ascii(vertices4 + "element face 1\nproperty int a\n", rows4 + "3\n"), "has no list vertex_indices"},
       {ascii("element vertex 1\nproperty quad x\n", "0\n"), "given.ply:4: \"quad\" is not a PLY type"},
       {"ply\nformat binary_middle_endian 1.0\n", "is not a PLY format"},
       {"ply\nformat ascii 1.0\nelement vertex 1\n", "the file ends before the end of the PLY header"},
       {"ply\n" + test::repeated("nonsense\n", 65), "given.ply:66: a PLY header cannot hold \"nonsense\""},
       {"ply\nproperty float x\n", "before the first element"},
       {ascii("", ""), "no vertices"}});
  Bytes b;
  for (int i = 0; i < 12; ++i) b.put(i == 7 ? NAN : 0.0f);
  CHECK(mentions(test::refusal(binary(vertices4, b), "ply"),
                 "given.ply: vertex 2: a coordinate is not a finite number"));
  Bytes cut;
  for (int i = 0; i < 12; ++i) cut.put(0.0f);
  cut.put(std::uint8_t{3}).put(0).put(1).put(2).put(std::uint8_t{3}).put(0);
  CHECK(mentions(test::refusal(binary(vertices4 + faces2, cut), "ply"),
                 "given.ply: face 1: a list announces 3 values"));
}

TEST_CASE("ply_points_are_read_with_a_warning") {
  const ReadResult r = test::read_text(ascii(vertices4, rows4), "ply");
  CHECK(r.surface.positions.size() == 4);
  REQUIRE(r.warnings.size() == 1);
  CHECK(mentions(r.warnings[0], "only a set of points"));
}

TEST_CASE("ply_written_polygons_of_more_than_255_corners_come_back") {
  Surface s;
  s.polygon_starts = {0, 300};
  for (std::uint32_t i = 0; i < 300; ++i) {
    s.positions.push_back({1.0 * i, 0, 0});
    s.corners.push_back(i);
  }
  triangulate(s);
  CHECK(test::read_text(test::bytes_by("ply", s), "ply").surface.corners == s.corners);
}
