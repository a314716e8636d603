// Parts of cages that are built alike, and one posed like the other.
#include "scene/hand/pose_alike.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "mesh/triangulation.h"
#include "scene/document/edit.h"
#include "scene/document/part_match.h"

using namespace viete;
using namespace viete::scene;

namespace {

using Numbers = std::vector<std::uint32_t>;
using Places = std::vector<mesh::Point>;

// A box that looks like no other one from any side.
Places odd_box() {
  Places places;
  for (int i = 0; i < 8; ++i) places.push_back({1.0 * (i & 1), 1.5 * (i >> 1 & 1), 2.0 * (i >> 2 & 1)});
  places[7] = {1.2, 1.6, 2.3};
  places[2] = {-0.1, 1.7, 0.2};
  return places;
}

constexpr std::uint32_t box_faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

// Two of them, the second one with its vertices in another order, and run round the other way if it is an
// image in a mirror.
Document two_boxes(const std::function<mesh::Point(const mesh::Point&)>& map, bool mirrored) {
  constexpr std::uint32_t order[8] = {5, 2, 7, 0, 1, 6, 3, 4};
  mesh::Surface s;
  s.positions = odd_box();
  s.positions.resize(16);
  for (std::uint32_t v = 0; v < 8; ++v) s.positions[8 + order[v]] = map(odd_box()[v]);
  s.polygon_starts = {0};
  for (const bool second : {false, true}) {
    for (const auto& face : box_faces) {
      for (int i = 0; i < 4; ++i) {
        const std::uint32_t v = face[second && mirrored ? 3 - i : i];
        s.corners.push_back(second ? 8 + order[v] : v);
      }
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    }
  }
  mesh::triangulate(s);
  Document document;
  document.cage = std::make_shared<const deform::Cage>(deform::make_cage(std::move(s)));
  document.pose = deform::rest_pose(*document.cage);
  return document;
}

Numbers from_to(std::uint32_t first, std::uint32_t end) {
  Numbers numbers(end - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

Places some_pose() {
  Places places = odd_box();
  for (std::size_t i = 0; i < 8; ++i)
    places[i] = {places[i][0] + 0.1 * std::sin(3.0 * double(i)), 1.2 * places[i][1] - 0.3,
                 places[i][2] + 0.05 * double(i)};
  return places;
}

double distance(const mesh::Point& a, const mesh::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// n by n quads in a plane about its middle.
Document plane(std::uint32_t n) {
  mesh::Surface s;
  s.polygon_starts = {0};
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x)
      s.positions.push_back({x - 0.5 * n, y - 0.5 * n + 0.1 * (y == n), 0});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t v = y * (n + 1) + x;
      for (const auto corner : {v, v + 1, v + n + 2, v + n + 1}) s.corners.push_back(corner);
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    }
  }
  mesh::triangulate(s);
  Document document;
  document.cage = std::make_shared<const deform::Cage>(deform::make_cage(std::move(s)));
  document.pose = deform::rest_pose(*document.cage);
  return document;
}

}  // namespace

TEST_CASE("a_part_takes_the_pose_of_another_one_turned_and_scaled_or_mirrored") {
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    const auto map = [&](const mesh::Point& p) {  // a quarter turn about Y, twice as large, elsewhere
      return mesh::Point{(mirrored ? -2 : 2) * p[2] + 10, 2 * p[1] + 1, -2 * p[0]};
    };
    Document document = two_boxes(map, mirrored);
    const Numbers part = from_to(0, 8), other = from_to(8, 16);
    const Places posed = some_pose();
    std::copy(posed.begin(), posed.end(), document.pose.positions.begin());
    CHECK(pose_alike(document, {part, posed, {}}, other, {}, nullptr) == "");
    std::string why;
    const auto match = match_parts(*document.cage, part, other, {}, why);
    REQUIRE(match);
    CHECK(match->fit.miss < 1e-12);
    for (std::uint32_t v = 0; v < 8; ++v)
      CHECK(distance(document.pose.positions[match->images[v]], map(posed[v])) < 1e-12);
    undo(document);
    CHECK(document.pose.positions[12] == document.cage->surface.positions[12]);
  }
}

TEST_CASE("an_end_takes_the_pose_of_another_end_relative_to_where_they_hang") {
  constexpr std::uint32_t n = 6;
  Document document = plane(n);
  Numbers left, right;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x < 2; ++x)
      left.push_back(y * (n + 1) + x), right.push_back(y * (n + 1) + n - 1 + x);
  }
  // All of it is turned by a right angle about X; one end is pulled up and out, in what was its own plane.
  const auto turned = [](const mesh::Point& p) { return mesh::Point{p[0], -p[2] + 3, p[1]}; };
  auto& now = document.pose.positions;
  for (auto& p : now) p = turned(p);
  Places posed;
  const auto& rest = document.cage->surface.positions;
  for (const auto v : left) {
    now[v] = turned({rest[v][0] - 1, rest[v][1], 0.5 - 0.2 * rest[v][0]});
    posed.push_back(now[v]);
  }
  CHECK(pose_alike(document, {left, posed, {}}, right, {}, nullptr) == "");
  for (const auto v : right)
    CHECK(distance(now[v], turned({rest[v][0] + 1, rest[v][1], 0.5 + 0.2 * rest[v][0]})) < 1e-12);
}

TEST_CASE("the_active_vertices_say_which_way_round_where_several_fit") {
  Document document = plane(2);  // but for its rim a square
  Numbers all = from_to(0, 9);
  std::string why;
  const auto free = match_parts(*document.cage, all, all, {}, why);
  REQUIRE(free);
  CHECK(free->images == all);
  const auto known = match_parts(*document.cage, all, all, KnownImage{0, 2}, why);
  REQUIRE(known);
  CHECK(known->images[0] == 2);
  CHECK(known->images[4] == 4);
  CHECK_FALSE(match_parts(*document.cage, all, all, KnownImage{0, 4}, why));
}

TEST_CASE("parts_that_do_not_match_are_told_so_and_stay") {
  Document document = plane(4);
  const Places before = document.pose.positions;
  const Numbers four{0, 1, 5, 6}, five{3, 4, 8, 9, 14}, row{20, 21, 22, 23}, corner{3, 4, 8, 9};
  const Places places(4, mesh::Point{1, 2, 3});
  CHECK(pose_alike(document, {four, places, {}}, five, {}, nullptr).find("4 and 5 vertices") !=
        std::string::npos);
  CHECK(pose_alike(document, {four, places, {}}, row, {}, nullptr).find("one by one") != std::string::npos);
  CHECK(pose_alike(document, {four, places, {}}, four, {}, nullptr).find("select the one") !=
        std::string::npos);
  CHECK(document.pose.positions == before);
  CHECK_FALSE(document.history.can_undo());
  CHECK(pose_alike(document, {four, places, {}}, corner, {}, nullptr) == "");
}
