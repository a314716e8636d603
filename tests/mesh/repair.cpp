#include "mesh/repair.h"

#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

TEST_CASE("welding_closes_a_triangle_soup_and_keeps_numbering") {
  const Surface whole = test::sphere(2);
  std::vector<Point> positions;
  std::vector<Triangle> triangles;
  for (const Triangle& t : whole.triangles) {
    for (const auto v : t) positions.push_back(whole.positions[v]);
    const auto n = static_cast<std::uint32_t>(positions.size());
    triangles.push_back({n - 3, n - 2, n - 1});
  }
  const Surface soup = from_triangles(positions, triangles), joined = welded(soup);
  CHECK(summarize(soup).boundary_edges.size() == 3 * whole.triangles.size());
  CHECK(summarize(joined).closed());
  CHECK(joined.positions == soup.positions);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      CHECK(joined.triangles[t][i] <= triangles[t][i]);
      CHECK(positions[joined.triangles[t][i]] == positions[triangles[t][i]]);
    }
}

TEST_CASE("disagreeing_faces_are_flipped_to_the_majority") {
  for (const Surface& sound : {test::sphere(2), test::torus(12, 8), test::torus(12, 8, true)}) {
    Surface s = sound;
    for (const std::size_t t : {3u, 4u, 17u, 30u}) std::swap(s.triangles[t][0], s.triangles[t][1]);
    s = from_triangles(s.positions, s.triangles);
    const Summary before = summarize(s), after = summarize(consistently_oriented(s));
    CHECK(!before.oriented());
    CHECK(after.oriented());
    CHECK(after.volume == doctest::Approx(summarize(sound).volume).epsilon(1e-12));
  }
}

TEST_CASE("inside_out_surfaces_stay_and_components_are_oriented_separately") {
  Surface s = test::sphere(2);
  for (auto& t : s.triangles) std::swap(t[0], t[1]);
  CHECK(consistently_oriented(s).triangles == s.triangles);
}

TEST_CASE("moebius_strip_stays_unchanged") {
  const Surface strip = test::moebius_strip();
  CHECK(!summarize(strip).oriented());
  CHECK(consistently_oriented(strip).triangles == strip.triangles);
  CHECK(one_sided(strip).triangles.empty());
}

TEST_CASE("one_sided_keeps_one_face_of_each_pair_and_orients_components") {
  const auto moved = [](Surface s, double by, double scale) {
    for (auto& p : s.positions) p = {scale * p[0] + by, scale * p[1], scale * p[2]};
    return s;
  };
  const auto turned = [](Surface s) {
    for (auto& t : s.triangles) std::swap(t[1], t[2]);
    return from_triangles(s.positions, s.triangles);
  };
  const auto volume_of = [](const Surface& s) {
    const OneSided one = one_sided(s);
    CHECK(one.closed);
    return summarize(from_triangles(s.positions, one.triangles)).volume;
  };
  const Surface ball = test::sphere(2);
  const double v = summarize(ball).volume;
  CHECK(one_sided(ball).triangles == ball.triangles);
  CHECK(one_sided(turned(ball)).triangles == turned(ball).triangles);
  const Surface hollow = test::both(ball, turned(moved(ball, 0, 0.5)));
  CHECK(one_sided(hollow).triangles == hollow.triangles);
  CHECK(volume_of(test::both(ball, moved(ball, 0, 0.5))) == doctest::Approx(v * (1 - 0.125)));
  CHECK(volume_of(test::both(ball, moved(turned(ball), 5, 1))) == doctest::Approx(2 * v));

  Surface two_sided = ball;
  const Surface back = turned(ball);
  two_sided.triangles.insert(two_sided.triangles.end(), back.triangles.begin(), back.triangles.end());
  two_sided = from_triangles(two_sided.positions, two_sided.triangles);
  CHECK(one_sided(two_sided).triangles == ball.triangles);
  std::ranges::reverse(two_sided.triangles);
  CHECK(std::abs(volume_of(from_triangles(two_sided.positions, two_sided.triangles))) == doctest::Approx(v));

  CHECK_FALSE(one_sided(test::torus(12, 8, true)).closed);
  CHECK(one_sided(test::torus(12, 8, true)).triangles.size() == test::torus(12, 8, true).triangles.size());
}
