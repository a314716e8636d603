#include "render/upload.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"

using namespace viete;
using render::Point;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("origin_is_the_first_finite_point") {
  CHECK(render::origin_of(std::vector<Point>{{not_a_number, 0, 0}, {1, 2, 3}, {4, 5, 6}}) == Point{1, 2, 3});
  CHECK(render::origin_of(std::vector<Point>{{0, INFINITY, 0}}) == Point{0, 0, 0});
  CHECK(render::origin_of({}) == Point{0, 0, 0});
}

TEST_CASE("relative_keeps_small_differences_of_large_numbers") {
  CHECK(render::relative({1e9 + 0.125, 1, -1e9}, {1e9, 0, -1e9}) == glm::vec3(0.125F, 1, 0));
  CHECK(render::relative({not_a_number, 1, 2}, {0, 0, 0}) == glm::vec3(0));
}

TEST_CASE("wrong_index_is_named_with_its_element") {
  const std::vector<std::array<std::uint32_t, 2>> segments{{0, 1}, {1, 7}};
  CHECK_NOTHROW(render::require_indices<2>("segments", segments, 8));
  CHECK_THROWS_WITH_AS(render::require_indices<2>("segments", segments, 7),
                       "segments: element 1: names vertex 7, there are 7", base::Error);
}
