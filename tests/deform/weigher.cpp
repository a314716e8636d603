#include "deform/weigher.h"

#include <doctest/doctest.h>

#include "deform/mean_value.h"
#include "deform/shapes.h"
#include "deform/weights.h"

using namespace viete::test;

namespace {

// Points in, on and outside the cage: near and on corners, edges and faces among them.
std::vector<viete::mesh::Point> points_around(const Cage& cage) {
  Random random(17);
  std::vector<viete::mesh::Point> points;
  for (int i = 0; i < 200; ++i) points.push_back(random.vector(1.5));
  const auto& p = cage.surface.positions;
  for (const auto& t : cage.surface.triangles) {
    const double u = random(0, 1), v = random(0, 1 - u);
    points.push_back(p[t[0]]);
    points.push_back(p[t[0]] + u * (p[t[1]] - p[t[0]]));
    points.push_back(p[t[0]] + u * (p[t[1]] - p[t[0]]) + v * (p[t[2]] - p[t[0]]));
    for (const double d : {1e-9, 1e-4, 0.1}) points.push_back(points.back() + random.vector(d));
  }
  while (points.size() % bind_lanes) points.push_back({0, 0, 0});
  return points;
}

}  // namespace

TEST_CASE("weights_of_eight_points_are_those_of_one_on_every_instruction_set") {
  auto surface = tube(5, 7, 0.8, 2);
  surface = together(surface, viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0.1}, {3, 1e-3, 0.1}, {3, 0, 2}},
                                                          {{0, 1, 2}, {3, 4, 5}}));  // one is a line, one a needle
  const Cage cage = make_cage(surface);
  const auto points = points_around(cage);
  for (const auto c : {Coordinates::face, Coordinates::mean_value}) {
    for (const auto& kernel : viete::sym3::kernels()) {
      const Weigher weigher(cage, c, kernel);
      std::vector<double> many(bind_lanes * weigher.handles()), one(weigher.handles());
      double worst = 0;
      for (std::size_t i = 0; i < points.size(); i += bind_lanes) {
        std::array<viete::mesh::Point, bind_lanes> eight;
        std::copy_n(points.begin() + std::ptrdiff_t(i), bind_lanes, eight.begin());
        weigher.weigh(eight, many);
        for (std::size_t l = 0; l < bind_lanes; ++l) {
          if (c == Coordinates::face) inverse_distance_weights(cage, eight[l], one);
          else mean_value_weights(cage, eight[l], one);
          for (std::size_t j = 0; j < one.size(); ++j) worst = std::max(worst, std::abs(many[j * bind_lanes + l] - one[j]));
        }
      }
      CAPTURE(kernel.name);
      CHECK(worst < 1e-6);  // where a point is 1e-9 from an element its distance has seven digits
    }
  }
}
