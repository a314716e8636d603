#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

std::string binary_stl(const Surface& s, std::string head) {
  head.resize(80, ' ');
  test::append(head, static_cast<std::uint32_t>(s.triangles.size()));
  for (const Triangle& t : s.triangles) {
    head.append(12, '\0');
    for (const auto v : t)
      for (const double x : s.positions[v]) test::append(head, static_cast<float>(x));
    head += "\x7f\x7f";
  }
  return head;
}

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

}  // namespace

TEST_CASE("stl_binary_joins_equal_corners_in_order_of_first_occurrence") {
  const Surface s = test::sphere(2);
  for (const std::string title : {"made by hand", "solid but binary", ""}) {
    const ReadResult r = test::read_text(binary_stl(s, title), "stl");
    test::check_invariants(r.surface);
    CHECK(r.format == "STL binary");
    CHECK(r.surface.positions.size() == s.positions.size());
    CHECK(r.surface.triangles.size() == s.triangles.size());
    CHECK(r.surface.triangles[0] == Triangle{0, 1, 2});
    CHECK(r.comments.size() == (title.empty() ? 0u : 1u));
    for (int i = 0; i < 3; ++i)
      CHECK(r.surface.positions[0][i] == static_cast<float>(s.positions[s.triangles[0][0]][i]));
  }
}

TEST_CASE("stl_zero_and_minus_zero_are_equal") {
  std::string text = "solid a\n" + facet;
  const std::string other =
      "facet normal 0 0 -1\nouter loop\nvertex -0 0 -0\nvertex 0 1 0\nvertex 1 0 "
      "0\nendloop\nendfacet\nendsolid\n";
  CHECK(test::read_text(text + other, "stl").surface.positions.size() == 3);
}

TEST_CASE("stl_text_may_be_upper_case_have_several_solids_and_names") {
  std::string upper = facet;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  const ReadResult r = test::read_text(
      "solid first part\n" + facet + "endsolid first part\nsolid\n" + upper + "ENDSOLID\n", "stl");
  CHECK(r.format == "STL ascii");
  CHECK(r.surface.triangles.size() == 2);
  CHECK(r.comments == std::vector<std::string>{"first part"});
  CHECK(r.warnings.empty());
  CHECK(test::read_text("SOLID\n" + upper + "ENDSOLID\n", "stl").format == "STL ascii");
}

TEST_CASE("stl_errors_name_line_or_triangle") {
  const std::string whole = binary_stl(test::sphere(1), "a");
  test::check_refusals(
      "stl", {{whole.substr(0, whole.size() - 10), "declares 32 triangles, the file has room for 31"},
              {whole.substr(0, 60), "a binary STL has at least 84 bytes"},
              {binary_stl(Surface{}, "a"), "no vertices"}});
  std::string huge = whole;
  for (int i = 80; i < 84; ++i) huge[i] = '\xff';
  CHECK(mentions(test::refusal(huge, "stl"), "declares 4294967295 triangles"));
  Surface infinite = test::sphere(1);
  infinite.positions[infinite.triangles[0][1]][2] = INFINITY;
  test::check_refusals(
      "stl", {{binary_stl(infinite, "a"), "given.stl: triangle 0: a coordinate is not a finite number"},
              {"solid a\n" + facet.substr(0, facet.size() - 9), "the file ends within a facet"},
              {"solid a\nvertex 0 0 0\n", "given.stl:2: a vertex is outside of a facet"},
              {"solid a\nfacet\nendfacet\n", "given.stl:3: a facet has 0 corners"},
              {"solid a\nnonsense\n", "\"nonsense\" is not an STL keyword"}});
}

TEST_CASE("stl_truncation_and_trailing_bytes_cause_warnings") {
  CHECK(mentions(test::read_text("solid a\n" + facet, "stl").warnings.at(0), "may be truncated"));
  CHECK(mentions(test::read_text(binary_stl(test::sphere(1), "a") + "tail", "stl").warnings.at(0),
                 "4 bytes after"));
  std::string fewer = binary_stl(test::sphere(1), "a");
  fewer[80] = 0;
  CHECK(mentions(test::refusal(fewer, "stl"), "declares 0 triangles, and 1600 bytes follow"));
  fewer[80] = 31;
  CHECK(mentions(test::read_text(fewer, "stl").warnings.at(0),
                 "50 bytes after the 31 triangles that the header"));
}

TEST_CASE("stl_attributes_after_triangles_are_skipped_and_kept") {
  const Surface s = test::sphere(1);
  const std::string plain = binary_stl(s, "attributes");
  for (const std::vector<std::uint16_t>& sizes :
       {std::vector<std::uint16_t>{0, 2, 4}, {7}, {0, 0, 0, 0, 300}, {65535}}) {
    std::string bytes = plain.substr(0, 84);
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      const std::uint16_t size = sizes[t % sizes.size()];
      bytes += plain.substr(84 + 50 * t, 48);
      test::append(bytes, size);
      bytes.append(size, '\x5a');
    }
    const ReadResult r = test::read_kept(bytes, "stl");
    CHECK(r.surface.positions.size() == s.positions.size());
    CHECK(r.surface.triangles.size() == s.triangles.size());
    CHECK(mentions(r.warnings.at(0), "attributes of triangles"));
    CHECK(test::written_again(r, r.surface.positions) == bytes);
    const std::string moved = test::written_again(r, test::moved(r.surface, 2).positions);
    CHECK(moved.size() == bytes.size());
    CHECK(test::read_text(moved, "stl").surface.positions == test::moved(r.surface, 2).positions);
    CHECK(mentions(test::refusal(bytes.substr(0, bytes.size() - 3), "stl"),
                   "the header declares 32 triangles"));
  }
}

TEST_CASE("stl_undefined_normals_of_moved_triangles_are_computed") {
  const std::vector<Point> moved = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  for (const char* normal : {"0 0 -inf", "nan nan nan", "1e999 0 0", "-nan(ind) 0 1"}) {
    std::string text = "solid a\n" + facet + "endsolid\n";
    text.replace(text.find("0 0 1"), 5, normal);
    const ReadResult r = test::read_kept(text, "stl");
    CHECK(test::written_again(r, r.surface.positions) == text);
    CHECK(mentions(test::written_again(r, moved), "facet normal 0 -1 0\n"));
  }
  for (const float bad : {-INFINITY, INFINITY, NAN}) {
    std::string bytes = binary_stl(from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), "a");
    std::string number;
    test::append(number, bad);
    bytes.replace(92, 4, number);
    const ReadResult r = test::read_kept(bytes, "stl");
    CHECK(test::written_again(r, r.surface.positions) == bytes);
    const std::string written = test::written_again(r, moved);
    CHECK(base::number_of_bytes<float>(&written[84]) == 0);
    CHECK(base::number_of_bytes<float>(&written[88]) == -1);
    CHECK(base::number_of_bytes<float>(&written[92]) == 0);
  }
}
