// Rewritten PLY, STL and OFF files are identical at rest. A deformation changes only the values it affects.

#include <sstream>

#include "formats/codecs.h"
#include "formats/write.h"
#include "support/far.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

// Builds a text file or a binary file. Records for each value whether a deformation may change the value.
class Maker {
public:
  enum class Form { text, little, big };
  explicit Maker(Form form) : form_(form) {}

  void text(const std::string& s) { bytes += s; }
  template <class T>
  void put(T value, bool may_change = false) {
    if (form_ == Form::text) {
      std::ostringstream out;
      if constexpr (sizeof(T) == 1) {
        out << int(value);
      } else {
        out.precision(7);
        out << value;
      }
      may.push_back(may_change);
      bytes += out.str() + ' ';
      return;
    }
    test::append(bytes, value, form_ == Form::little ? std::endian::little : std::endian::big);
    may.resize(bytes.size(), may_change);
  }
  void end_row() {
    if (form_ == Form::text) bytes += "\r\n";
  }
  void body_begins() {
    body = bytes.size();
    if (form_ != Form::text) may.assign(body, false);
  }

  std::string bytes;
  std::vector<char> may;  // one per byte (binary file) or word (text body): may it change?
  std::size_t body = 0;
  Form form() const { return form_; }

private:
  Form form_;
};

// Returns a grid of quads on a curved sheet, with properties of every kind and with other elements.
Maker rich_ply(Maker::Form form) {
  Maker m(form);
  const char* const format[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  m.text("ply\r\nformat " + std::string(format[int(form)]) +
         " 1.0\r\ncomment made up\r\nobj_info of nothing\r\nelement camera 2\r\nproperty list uchar float "
         "matrix\r\nproperty short id\r\nelement vertex 16\r\nproperty uchar flags\r\nproperty double "
         "x\r\nproperty float z\r\nproperty double y\r\nproperty ushort q\r\nproperty float nx\r\nproperty "
         "float ny\r\nproperty float nz\r\nproperty float tx\r\nproperty float ty\r\nproperty float "
         "tz\r\nproperty uchar red\r\nproperty uchar green\r\nproperty uchar blue\r\nproperty float "
         "s\r\nproperty "
         "float t\r\nproperty list uint char history\r\nelement face 10\r\nproperty int material\r\nproperty "
         "list uchar int vertex_indices\r\nproperty float nx\r\nproperty float ny\r\nproperty float "
         "nz\r\nelement edge 2\r\nproperty int vertex1\r\nproperty int vertex2\r\nend_header\r\n");
  m.body_begins();
  for (int i = 0; i < 2; ++i) {
    m.put<std::uint8_t>(2);
    m.put(0.5F);
    m.put(1e-20F);
    m.put<std::int16_t>(-7);
    m.end_row();
  }
  for (int v = 0; v < 16; ++v) {
    const double x = v % 4 + 0.25, y = v / 4 + 0.5, z = 0.125 * x * y;
    const double length = std::hypot(0.125 * y, 0.125 * x, 1);
    m.put<std::uint8_t>(static_cast<std::uint8_t>(v));
    m.put(x, true);
    m.put(static_cast<float>(z), true);
    m.put(y, true);
    m.put<std::uint16_t>(40000);
    for (const double n : {-0.125 * y, -0.125 * x, 1.0}) m.put(static_cast<float>(n / length), true);
    for (const float t : {1.0F, 0.0F, 0.0F}) m.put(t, true);
    for (const int c : {255, 0, v}) m.put(static_cast<std::uint8_t>(c));
    m.put(static_cast<float>(x / 4));
    m.put(static_cast<float>(y / 4));
    m.put<std::uint32_t>(1);
    m.put<std::int8_t>(-3);
    m.end_row();
  }
  for (int f = 0; f < 10; ++f) {
    const int corner = f % 3 + 4 * (f / 3);
    m.put<std::int32_t>(f);
    const std::vector<int> corners =
        f == 9 ? std::vector{1, 2} : std::vector{corner, corner + 1, corner + 5, corner + 4};
    m.put(static_cast<std::uint8_t>(corners.size()));
    for (const int c : corners) m.put<std::int32_t>(c);
    for (const float n : {0.0F, 0.0F, 1.0F}) m.put(n, f < 9);
    m.end_row();
  }
  m.put(0);
  m.put(1);
  m.end_row();
  m.put(2);
  m.put(3);
  m.end_row();
  return m;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

void check_kept(const Maker& m, const std::string& written) {
  CHECK(written.substr(0, m.body) == m.bytes.substr(0, m.body));
  if (m.form() != Maker::Form::text) {
    REQUIRE(written.size() == m.bytes.size());
    for (std::size_t i = m.body; i < written.size(); ++i)
      if (!m.may[i]) REQUIRE(written[i] == m.bytes[i]);
    return;
  }
  const auto before = words_of(m.bytes.substr(m.body)), after = words_of(written.substr(m.body));
  REQUIRE(before.size() == after.size());
  for (std::size_t i = 0; i < after.size(); ++i)
    if (!m.may[i]) REQUIRE(before[i] == after[i]);
}

Point turned(const Point& p) {
  return {-p[1], p[0], p[2]};
}

}  // namespace

TEST_CASE("ply_original_is_identical_at_rest_and_updates_dependent_values") {
  for (const auto form : {Maker::Form::text, Maker::Form::little, Maker::Form::big}) {
    CAPTURE(int(form));
    const Maker m = rich_ply(form);
    const ReadResult read = test::read_kept(m.bytes, "ply");
    CHECK(read.surface.polygon_count() == 9);
    REQUIRE(read.attributes);
    CHECK(read.attributes->colors[5] == Color{1, 0, 5.0F / 255, 1});
    CHECK(read.attributes->texture_points[5][0] == doctest::Approx(1.25 / 4));
    CHECK(read.attributes->corner_normal == read.surface.corners);
    CHECK(test::written_again(read, read.surface.positions) == m.bytes);
    auto moved = read.surface.positions;
    for (Point& p : moved) p = turned(p);
    const std::string written = test::written_again(read, moved);
    check_kept(m, written);
    const ReadResult again = test::read_kept(written, "ply");
    for (std::size_t v = 0; v < 16; ++v) {
      CHECK(norm(again.surface.positions[v] - moved[v]) < 1e-5);
      CHECK(norm(again.attributes->normals[v] - turned(read.attributes->normals[v])) < 1e-4);
      CHECK(again.attributes->colors[v] == read.attributes->colors[v]);
    }
    const std::string back = test::written_again(again, read.surface.positions);
    check_kept(m, back);
    // The rotation turns tangents from (1, 0, 0) to (0, 1, 0).
    if (form != Maker::Form::text) continue;
    const auto words = words_of(written.substr(m.body));
    const auto before = words_of(m.bytes.substr(m.body));
    const std::size_t first_tangent = 8 + 8;
    CHECK(std::stod(before[first_tangent]) == 1);
    CHECK(std::abs(std::stod(words[first_tangent])) < 1e-6);
    CHECK(std::stod(words[first_tangent + 1]) == doctest::Approx(1));
  }
}

TEST_CASE("position_beyond_float_range_is_rejected") {
  std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  const ReadResult ply = test::read_kept(head + std::string(12, '\0'), "ply");
  CHECK_THROWS_WITH_AS(test::written_again(ply, {{1e39, 0, 0}}),
                       "given.ply: vertex 0: the new value exceeds the range of its number type in this "
                       "file; save in another format, or scale the model",
                       base::Error);
  std::string stl(84 + 50, '\0');
  stl[80] = 1;
  const ReadResult of_stl = test::read_kept(stl, "stl");
  CHECK_THROWS_AS(test::written_again(of_stl, {{1e39, 0, 0}}), base::Error);
}

TEST_CASE("rounding_of_far_positions_by_the_file_is_noted_with_its_size") {
  const test::TemporaryFolder folder;
  const Surface near = test::cube(), far = test::far_away(near);
  const auto floats_in_place = [&](const Surface& surface, const char* name) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n";
    for (const Point& p : surface.positions)
      for (const double x : p) bytes += std::string_view(base::bytes_of_number(float(x)).data(), 4);
    const ReadResult r = test::put_and_read(folder / name, bytes);
    std::vector<Point> moved = r.surface.positions;
    for (Point& p : moved) p[1] += 0.2;
    return write(folder / "out.ply", {r.surface, moved, {}}, r.original.get(), {});
  };
  CHECK(floats_in_place(near, "near.ply").empty());
  const std::vector<std::string> notes = floats_in_place(far, "far.ply");
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].starts_with("the number type of the file rounds coordinates by up to 0.2 ("));
}

TEST_CASE("ply_integer_positions_stay_integers") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\nproperty int "
      "z\nend_header\n1 2 3\n100 5 6\n";
  const ReadResult read = test::read_kept(text, "ply");
  CHECK(mentions(test::written_again(read, {{1.4, 2, 3}, {100, 5.6, 6}}), "end_header\n1 2 3\n100 6 6\n"));
  CHECK_THROWS_AS(test::written_again(read, {{3e9, 2, 3}, {100, 5.6, 6}}), base::Error);
}

TEST_CASE("stl_binary_keeps_header_and_attributes") {
  std::string bytes = "Exported by someone, COLOR=abcd";
  bytes.resize(80, ' ');
  const Surface ball = test::sphere(1);
  const auto put = [&](auto value) { test::append(bytes, value); };
  put(static_cast<std::uint32_t>(ball.triangles.size()));
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const auto& [a, b, c] = ball.triangles[t];
    const Point n = cross(ball.positions[b] - ball.positions[a], ball.positions[c] - ball.positions[a]);
    for (const double x : n) put(t % 5 == 0 ? 0.0F : static_cast<float>(x / norm(n)));
    for (const auto v : {a, b, c})
      for (const double x : ball.positions[v]) put(static_cast<float>(x == 0 ? -0.0 : x));
    put(static_cast<std::uint16_t>(1000 + t));
  }
  bytes += "tail";
  const ReadResult read = test::read_kept(bytes, "stl");
  CHECK(test::written_again(read, read.surface.positions) == bytes);
  auto moved = read.surface.positions;
  for (Point& p : moved) p = turned(p);
  const std::string written = test::written_again(read, moved);
  REQUIRE(written.size() == bytes.size());
  CHECK(written.substr(0, 84) == bytes.substr(0, 84));
  CHECK(written.ends_with("tail"));
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const std::size_t at = 84 + 50 * t;
    CHECK(written.substr(at + 48, 2) == bytes.substr(at + 48, 2));
    for (int i = 0; i < 4; ++i) {
      Point before, after;
      for (int k = 0; k < 3; ++k) {
        before[k] = base::number_of_bytes<float>(&bytes[at + 12 * i + 4 * k]);
        after[k] = base::number_of_bytes<float>(&written[at + 12 * i + 4 * k]);
      }
      CHECK(norm(after - turned(before)) < 1e-6);
    }
  }
}

TEST_CASE("stl_text_keeps_solids_and_the_form_of_numbers") {
  const std::string text =
      "solid left one\n facet normal 0.000000e+00 0.000000e+00 1.000000e+00\n  outer loop\n"
      "   vertex 0.000000e+00 0.000000e+00 0.000000e+00\n   vertex 1.000000e+00 0.000000e+00 0.000000e+00\n"
      "   vertex 0.000000e+00 1.000000e+00 0.000000e+00\n  endloop\n endfacet\nendsolid left one\n"
      "SOLID right\nFACET NORMAL x y z\nOUTER LOOP\nVERTEX 5.000000e+00 0.000000e+00 0.000000e+00\n"
      "VERTEX 6.000000e+00 0.000000e+00 0.000000e+00\nVERTEX 5.000000e+00 1.000000e+00 0.000000e+00\n"
      "ENDLOOP\nENDFACET\nENDSOLID\n";
  const ReadResult read = test::read_kept(text, "stl");
  CHECK(test::written_again(read, read.surface.positions) == text);
  auto moved = read.surface.positions;
  for (std::size_t v = 0; v < 3; ++v) moved[v] = {moved[v][0], -moved[v][2], moved[v][1]};
  const std::string written = test::written_again(read, moved);
  CHECK(mentions(written,
                 "solid left one\n facet normal 0.000000e+00 -1.000000e+00 0.000000e+00\n  outer loop\n"
                 "   vertex 0.000000e+00 0.000000e+00 0.000000e+00\n"));
  CHECK(mentions(written, "   vertex 0.000000e+00 0.000000e+00 1.000000e+00\n  endloop\n"));
  CHECK(written.substr(written.find("endsolid")) == text.substr(text.find("endsolid")));
}

TEST_CASE("off_keeps_colours_comments_and_texture") {
  const std::string rows =
      "# counts\r\n3 1 0\r\n\r\n0.00 0.00 0.00  0 0 1  255 0 51 255  0.5 0.25 # first\r\n"
      "1.00 0.00 0.00  0 0 1  0 0 0 255  0 0\r\n0.00 1.00 0.00  0 0 1  0 0 0 255  0 1\r\n3 0 1 2  10 20 "
      "30\r\n# end";
  const ReadResult read = test::read_kept("STCNOFF\r\n" + rows, "off");
  REQUIRE(read.attributes);
  CHECK(read.attributes->colors[0] == Color{1, 0, 0.2F, 1});
  CHECK(read.attributes->texture_points[0] == Vec2{0.5, 0.25});
  CHECK(read.attributes->normals[2] == Vec3{0, 0, 1});
  CHECK(test::written_again(read, read.surface.positions) == "STCNOFF\r\n" + rows);
  const std::string written = test::written_again(read, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}});
  CHECK(written ==
        "STCNOFF\r\n# counts\r\n3 1 0\r\n\r\n0.00 0.00 0.00  0 -1 0  255 0 51 255  0.5 0.25 # first\r\n"
        "1.00 0.00 0.00  0 -1 0  0 0 0 255  0 0\r\n0.00 0 1  0 -1 0  0 0 0 255  0 1\r\n3 0 1 2  10 20 "
        "30\r\n# end");
  const ReadResult plain = test::read_kept("OFF\r\n" + rows, "off");
  REQUIRE(plain.attributes);
  CHECK(plain.attributes->colors.empty());
  CHECK(plain.attributes->polygon_colors == std::vector<Color>{{10 / 255.0F, 20 / 255.0F, 30 / 255.0F, 1}});
  CHECK(test::written_again(plain, plain.surface.positions) == "OFF\r\n" + rows);
}
