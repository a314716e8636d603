#include "mesh/off.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

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
  CHECK(holds(test::refusal("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n3 0 1 2\n", "off"),
              "given.off:7: face refers to vertex 4 (from 0), the file has 4"));
  CHECK(holds(test::refusal("OFF\n2000000000 2000000000 0\n0 0 0\n", "off"),
              "given.off:2: 2000000000 vertices and"));
  CHECK(holds(test::refusal("OFF\n-4 2 0\n" + body, "off"), "vertex count -4 is negative"));
  CHECK(holds(test::refusal("OFF\n4 3 0\n" + body + "    ", "off"), "the file ends before the last face"));
  CHECK(holds(test::refusal("OFF\n4 2 0\n0 0 0\n1 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "off"),
              "given.off:4: a coordinate is missing"));
  CHECK(holds(test::refusal("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2\n", "off"),
              "given.off:7: a vertex index is missing"));
  CHECK(holds(test::refusal("4OFF\n4 2 0\n" + body, "off"), "positions of four or n numbers"));
  CHECK(holds(test::refusal("OFF BINARY\n4 2 0\n" + body, "off"), "binary OFF is not read"));
  CHECK(holds(test::refusal("OFF\n", "off"), "the file ends before the counts"));
  CHECK(holds(test::refusal("OFF\n0 0 0\n", "off"), "no vertices"));
}
