#include "weights/weigher.h"

#include "deform/bound.h"
#include "weights/point_weights.h"

using namespace viete::test;

namespace {

// Returns points inside, on and outside the cage. Some are near corners, edges and faces, or on them.
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

// Computes weights by their definitions. Returns their sum before normalisation.
double weights_of_one(const Cage& cage, const Weighting& weighting, const viete::mesh::Point& p,
                      std::span<double> weights) {
  if (weighting.weights == Weights::mean_value) {
    mean_value_weights(cage, p, weights);
    return 1;
  }
  const auto& x = cage.surface.positions;
  double sum = 0;
  for (std::size_t h = 0; h < weights.size(); ++h) {
    const auto [t, weighs] = handle_shape(cage, weighting.elements, h);
    const double d =
        std::sqrt(viete::mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
    const double part = std::max(d, cage.contact), left = std::max(0.0, 1 - d / weighting.radius / cage.size);
    weights[h] = !weighs ? 0 : weighting.weights == Weights::inverse ? 1 / (part * part) : left * left;
    sum += weights[h];
  }
  for (double& w : weights) w /= sum > 0 ? sum : 1;
  return sum;
}

const Weighting weightings[] = {faces,
                                mean_values,
                                {Elements::point, Weights::inverse},
                                {Elements::face, Weights::cut_off},
                                {Elements::face, Weights::cut_off, 0.6},
                                {Elements::point, Weights::cut_off, 0.1}};

// Weighs eight points at a time. For each point, calls use(index, weights, share, failed).
template <class Use>
void for_points(const Weigher& weigher, std::span<const viete::mesh::Point> points, const Use& use) {
  std::vector<double> scratch(weigher.scratch_size()), weights(weigher.handles());
  for (std::size_t i = 0; i < points.size(); i += bind_lanes) {
    Weigher::LaneShares shares;
    const unsigned lost = weigher.weigh(points.subspan(i).first<bind_lanes>(), scratch, shares);
    for (std::size_t l = 0; l < bind_lanes; ++l) {
      for (std::size_t j = 0; j < weights.size(); ++j) weights[j] = scratch[j * bind_lanes + l];
      use(i + l, weights, shares[l], bool(lost >> l & 1));
    }
  }
}

}  // namespace

TEST_CASE("weights_of_eight_points_are_those_of_one_on_every_instruction_set") {
  auto surface = tube(5, 7, 0.8, 2);
  surface = together(surface, viete::mesh::from_triangles(
                                  {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0.1}, {3, 1e-3, 0.1}, {3, 0, 2}},
                                  {{0, 1, 2}, {3, 4, 5}}));  // a line and a needle
  const Cage cage = make_cage(surface);
  const auto points = points_around(cage);
  for (const auto& weighting : weightings) {
    CAPTURE(base::entry_of(weighting.weights).word);
    for (const auto& kernel : viete::sym3::kernels()) {
      const Weigher weigher(cage, weighting, kernel);
      std::vector<double> one(weigher.handles());
      double worst = 0;
      for_points(weigher, points, [&](std::size_t i, const auto& weights, double share, bool) {
        const double total = weights_of_one(cage, weighting, points[i], one);
        for (std::size_t j = 0; j < one.size(); ++j) worst = std::max(worst, std::abs(weights[j] - one[j]));
        if (weighting.partial()) CHECK(share == doctest::Approx(std::min(total, 1.0)).epsilon(1e-12));
      });
      CAPTURE(kernel.name);
      CHECK(worst < 1e-6);  // at a distance of 1e-9 from an element, seven digits are valid
    }
  }
}

TEST_CASE("missing_mean_values_are_reported_per_lane") {
  const Cage cage = make_cage(viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  std::array<viete::mesh::Point, bind_lanes> points;
  points.fill({0.2, 0.2, 0.5});
  points[3] = points[6] = {0.25, -1, 0};  // in the triangle's plane but outside of the triangle
  for (const auto& kernel : viete::sym3::kernels()) {
    const Weigher weigher(cage, mean_values, kernel);
    std::vector<double> scratch(weigher.scratch_size());
    Weigher::LaneShares shares;
    CHECK(weigher.weigh(points, scratch, shares) == (1u << 3 | 1u << 6));
    CHECK(scratch[0 * bind_lanes + 3] == doctest::Approx(0.75));
    CHECK(scratch[1 * bind_lanes + 6] == doctest::Approx(0.25));
  }
}

TEST_CASE("float_tiles_equal_weights_in_double_at_any_points") {
  auto surface = tube(5, 7, 0.8, 2);
  surface = together(surface,
                     viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}));  // a line
  for (const double scale : {1e-30, 1.0, 1e30}) {
    auto scaled = surface;
    for (auto& p : scaled.positions) p = scale * p;
    const Cage cage = make_cage(scaled);
    for (const auto& weighting : weightings) {
      const bool by_distance = weighting.weights != Weights::mean_value;
      auto points = points_around(make_cage(surface));
      const double farthest = by_distance ? 1e25 : 10;  // mean value weights grow with the distance
      for (double far = 10; far <= farthest; far *= 1e5) points.push_back({far, 0.5 * far, 1});
      points.resize((points.size() + 15) / 16 * 16, {0.1, 0.2, 0.3});
      for (auto& p : points) p = scale * p;
      for (const auto& kernel : viete::sym3::kernels()) {
        CAPTURE(kernel.name);
        CAPTURE(scale);
        const Weigher weigher(cage, weighting, kernel);
        std::vector<float> rows(points.size() * weigher.handles());
        std::vector<Vec3> sums(points.size());
        std::vector<float> shares(points.size());
        const auto failed = weigher.weigh_tiles(points, rows.data(), sums, shares);
        double worst = 0, off = 0;
        for_points(weigher, points, [&](std::size_t i, const auto& weights, double exact, bool lost) {
          CHECK(failed[i] == lost);
          CHECK(std::abs(shares[i] - exact) < 1e-5);
          const double share = weighting.partial() ? exact : 1;  // for small shares, weights lose digits
          Vec3 sum{0, 0, 0};
          for (std::size_t j = 0; j < weights.size(); ++j) {
            const double w = rows[i / 16 * 16 * weights.size() + j * 16 + i % 16];
            worst = std::max(worst, share * std::abs(w - weights[j]));
            sum = sum + w * weigher.handle_positions()[j];
          }
          off = std::max(off, norm(sum - sums[i]));
        });
        CHECK(worst < (by_distance ? 2e-6 : 2e-5));
        CHECK(off < 1e-13 * cage.diagonal);
      }
    }
  }
}
