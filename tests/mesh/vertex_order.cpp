#include "mesh/vertex_order.h"

#include <numeric>

#include "support/shapes.h"

using namespace viete::mesh;
using namespace viete::test;

namespace {

using Order = std::vector<std::uint32_t>;

// Returns the cube after `change(face, corners)` of each face's four corners, with its faces in reverse
// order.
template <class Change>
Surface changed(const Change& change) {
  Surface s = cube();
  std::ranges::reverse(s.corners);
  for (std::size_t f = 0; f < s.polygon_count(); ++f) change(std::span(s.corners).subspan(4 * f, 4));
  triangulate(s);
  return s;
}

Order in_order() {
  Order all(8);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

TEST_CASE("faces_in_any_order_with_any_first_corner_keep_the_vertices") {
  const Surface s = changed([](std::span<std::uint32_t> face) {
    std::ranges::reverse(face);
    std::ranges::rotate(face, face.begin() + 1);
  });
  CHECK_FALSE(same_faces(s, cube()));
  CHECK(vertex_order(s, cube(), true) == in_order());
  CHECK_FALSE(vertex_order(s, cube(), false));  // the format may have numbered the vertices again
  Surface points = cube();
  points.corners.clear();
  points.triangles.clear();
  points.polygon_starts = {0};
  CHECK(vertex_order(points, cube(), true) == in_order());
  points.positions.pop_back();
  CHECK_FALSE(vertex_order(points, cube(), true));
}

TEST_CASE("renumbered_vertices_are_matched_by_faces_in_the_same_order_or_not_at_all") {
  const Order number{3, 6, 0, 5, 1, 7, 2, 4};
  Surface s = cube();
  for (auto& c : s.corners) c = number[c];
  triangulate(s);
  CHECK(vertex_order(s, cube(), true) == number);
  std::ranges::rotate(s.corners, s.corners.begin() + 4);
  triangulate(s);
  CHECK_FALSE(vertex_order(s, cube(), true));
  CHECK(first_difference(s, cube(), "the cage")
            .starts_with("neither the vertices nor the faces are in the order of the cage: face 0 (counted "
                         "from 0) has the vertices "));
}
