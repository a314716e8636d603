#include "shapes/spaces.h"

#include <doctest/doctest.h>

#include "support/caged_shapes.h"
#include "support/skip.h"

using namespace viete;
using namespace viete::test;

namespace {

using Points = std::vector<mesh::Point>;

// A model with its log space, for shapes between rest and other shapes.
struct Shapes {
  mesh::Surface rest;
  base::WorkerPool pool;
  ShapeSpace space;

  explicit Shapes(mesh::Surface surface, int threads = 1)
      : rest(std::move(surface)), pool(threads), space(rest, pool) {}

  Points mixed(std::span<const LogTerm> terms) {
    Points positions(rest.positions.size());
    LogSpace::Work work;
    space.shape(terms, space.logs().anchors_from(space.logs().at_rest(), terms), pool, work, positions);
    return positions;
  }
  Points share(const Points& shape, double factor, ShapeReport* report = nullptr) {
    const LogVector vector = space.vector(shape, pool, nullptr, report);
    const LogTerm term{&vector, factor};
    return mixed({&term, 1});
  }
  double error(const Points& a, const Points& b) const {
    return largest_distance(a, b) / mesh::bounds(rest.positions).diagonal();
  }
};

// Moves each part so that its center is at the origin.
Points centered(Points points, std::size_t part_size) {
  for (std::size_t first = 0; first < points.size(); first += part_size) {
    Vec3 mean{0, 0, 0};
    for (std::size_t v = first; v < first + part_size; ++v) mean = mean + points[v];
    for (std::size_t v = first; v < first + part_size; ++v)
      points[v] = points[v] - (1.0 / static_cast<double>(part_size)) * mean;
  }
  return points;
}

// Returns the tube after rotating its rings about z. The angle grows along the tube.
Points twisted(const mesh::Surface& tube, double degrees) {
  const auto box = mesh::bounds(tube.positions);
  return mapped(tube.positions, Twist{2, {0, 0, 0}, box.low[2], box.high[2], 0, degrees * degree});
}

// Compares edge lengths in `between` with their geometric means in `a` and `b`. Returns the RMS log ratio.
double edge_error(const mesh::Surface& s, const Points& a, const Points& b, const Points& between) {
  double sum = 0;
  for (const auto& t : s.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto i = t[k], j = t[(k + 1) % 3];
      const double expected = std::sqrt(norm(a[i] - a[j]) * norm(b[i] - b[j]));
      sum += std::pow(std::log(norm(between[i] - between[j]) / expected), 2);
    }
  return std::sqrt(sum / static_cast<double>(3 * s.triangles.size()));
}

double volume(const mesh::Surface& s, const Points& p) {
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles) sum += dot(p[a], cross(p[b], p[c])) / 6;
  return std::abs(sum);
}

}  // namespace

TEST_CASE("half_of_a_half_turn_is_a_quarter_turn_of_each_part") {
  const mesh::Surface limb = tube(9, 7, 0.3, 2);
  const std::size_t n = limb.positions.size();
  const mesh::Surface far = mapped(limb, scaling(1, {5, 0, 0}));
  Shapes s(together(limb, far));
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 2, -3}})
    for (const double angle : {179.0, 90.0, -150.0}) {
      const auto turned = [&](double share) {
        Points both = limb.positions;
        for (const Vec3& x : far.positions) both.push_back(similarity(axis, share * angle * degree)(x));
        return both;
      };
      const Points half = s.share(turned(1), 0.5);
      CHECK(s.error(centered(half, n), centered(turned(0.5), n)) < 1e-12);
    }
}

TEST_CASE("vectors_reproduce_shapes_and_rest_and_rotations_interpolate_about_their_axis") {
  Shapes s(tube(9, 7, 0.3, 2));
  for (const double degrees : {20.0, 285.0}) {
    const Points shape = twisted(s.rest, degrees);
    CHECK(s.error(s.share(shape, 1), shape) < 1e-12);
    CHECK(s.error(s.share(shape, 0), s.rest.positions) == 0);
  }
  const auto at = [&](double share) {
    return mapped(s.rest.positions, similarity({1, 1, 0}, share * 100 * degree, std::pow(4, share)));
  };
  for (const double share : {0.25, 0.5, 1.0, 1.5, -0.5})
    CHECK(s.error(s.share(at(1), share), at(share)) < 1e-12);
}

TEST_CASE("limbs_that_turn_by_more_than_half_a_turn_are_coherent") {
  Shapes s(tube(60, 12, 0.3, 6));
  for (const double degrees : {170.0, 285.0, 340.0}) {
    ShapeReport report;
    const Points shape = twisted(s.rest, degrees);
    const Points half = s.share(shape, 0.5, &report);
    CHECK(report.torn == 0);
    CHECK(report.folded == 0);
    CHECK(edge_error(s.rest, s.rest.positions, shape, half) < 0.05);
    CHECK(volume(s.rest, half) > 0.95 * volume(s.rest, shape));
  }
}

TEST_CASE("a_flipped_triangle_rotates_no_others") {
  Shapes s(tube(60, 12, 0.3, 6));
  Points shape = twisted(s.rest, 285);
  const Points sound = s.share(shape, 0.5);
  // Moves a vertex across the edge between two of its neighbours, so that triangles fold.
  const auto& t = s.rest.triangles[s.rest.triangles.size() / 2];
  const std::uint32_t moved = t[0];
  shape[moved] = shape[t[1]] + shape[t[2]] - shape[moved];
  ShapeReport report;
  const Points half = s.share(shape, 0.5, &report);
  CHECK(report.torn + report.folded > 0);
  std::size_t far = 0;
  for (std::size_t v = 0; v < half.size(); ++v)
    far += norm(half[v] - sound[v]) > 0.1 * norm(s.rest.positions[t[1]] - s.rest.positions[t[2]]);
  CHECK(far < 30);
}

TEST_CASE("flat_models_stay_flat_to_the_bit") {
  Shapes s(mapped(grid(8), scaling(1, {0, 0, 0.1})));
  Points bent = s.rest.positions;
  for (auto& p : bent) {
    const double angle = 0.4 * p[0], r = 10 - p[1];
    p = {r * std::sin(angle), 10 - r * std::cos(angle), p[2]};
  }
  for (const double share : {0.1, 0.5, 1.7, -1.0})
    for (const auto& p : s.share(bent, share)) REQUIRE(p[2] == 0.1);
}

TEST_CASE("position_and_scale_of_a_shape_do_not_matter") {
  const mesh::Surface limb = tube(30, 9, 0.3, 4);
  Shapes here(limb);
  const Points half = here.share(twisted(limb, 285), 0.5);
  const auto same = [&](const Affine& map, double allowed) {
    Shapes there(mapped(limb, map));
    return there.error(there.share(mapped(twisted(limb, 285), map), 0.5), mapped(half, map)) < allowed;
  };
  CHECK(same(scaling(1e30), 1e-12));
  CHECK(same(scaling(1e-30), 1e-12));
  CHECK(same(scaling(1, {1e5, -1e5, 1e5}), 1e-8));
}

TEST_CASE("shapes_have_the_same_bits_on_any_number_of_threads") {
  const mesh::Surface limb = tube(60, 12, 0.3, 6);
  Points first;
  for (const int threads : {1, 2, 3}) {
    Shapes s(limb, threads);
    Points shape = twisted(limb, 285);
    shape[100] = shape[101];
    const Points half = s.share(shape, 0.4);
    if (first.empty()) first = half;
    CHECK(half == first);
  }
}

TEST_CASE("branches_continue_those_of_the_preceding_shape") {
  Shapes s(tube(9, 7, 0.3, 2));
  const auto turned = [&](double degrees) {
    return mapped(s.rest.positions, similarity({0, 0, 1}, degrees * degree));
  };
  LogVector before = s.space.vector(turned(0), s.pool);
  for (double degrees = 150; degrees <= 750; degrees += 150) {
    const LogVector v = s.space.vector(turned(degrees), s.pool, &before);
    const std::array terms{LogTerm{&before, 0.5}, LogTerm{&v, 0.5}};
    CHECK(s.error(centered(s.mixed(terms), s.rest.positions.size()),
                  centered(turned(degrees - 75), s.rest.positions.size())) < 1e-11);
    before = v;
  }
}

TEST_CASE("collapsed_shapes_and_loose_vertices_are_finite_and_come_back") {
  mesh::Surface surface = tube(9, 7, 0.3, 2);
  surface.positions.push_back({7, 7, 7});  // has no triangle
  Shapes s(surface);
  for (const Vec3& scale : {Vec3{1, 1, 0}, Vec3{-1, 1, 1}, Vec3{0, 0, 0}, Vec3{1, 1e-9, 1}}) {
    const Points shape =
        mapped(s.rest.positions, Affine{{scale[0], 0, 0, 0, scale[1], 0, 0, 0, scale[2]}, {0.5, 0, 0}});
    CHECK(s.error(s.share(shape, 1), shape) < 1e-12);
    for (const double share : {0.5, 1.5, -0.5}) CHECK(all_finite(s.share(shape, share)));
  }
  Points moved = s.rest.positions;
  moved.back() = {7, 7, 9};
  CHECK(s.share(moved, 0.5).back() == mesh::Point{7, 7, 8});
}

TEST_CASE("shapes_of_large_models_twist_like_those_of_small_models" * doctest::test_suite(longer)) {
  const int rings = rounds(450, 3200);
  mesh::Surface limb = tube(rings, rounds(200, 1000), 0.3, 6);
  limb.positions.push_back({7, 7, 7});  // has no triangle
  REQUIRE(limb.positions.size() > most_solved_vertices);
  const auto twisted_limb = [&](double degrees) {
    Points shape = mapped(limb.positions, Twist{2, {0, 0, 0}, -3, 3, 0, degrees * degree});
    for (std::size_t v = 0; v < shape.size(); ++v)
      shape[v][0] *= 1 + 4.5 / rings * double(v % 2);  // finer than clusters
    shape.back() = {7, 7, 9};
    return shape;
  };
  Points first;
  for (const int threads : {1, 2}) {
    Shapes s(limb, threads);
    REQUIRE(s.space.coarse());
    const Points shape = twisted_limb(285);
    ShapeReport report;
    const Points half = s.share(shape, 0.5, &report);
    if (first.empty()) first = half;
    CHECK(half == first);
    CHECK(report.coarse);
    CHECK(report.torn == 0);
    CHECK(s.error(s.share(shape, 0), limb.positions) < 1e-15);
    CHECK(s.error(s.share(shape, 1), shape) < 1e-12);
    CHECK(edge_error(s.rest, s.rest.positions, shape, half) < 0.05);
    CHECK(volume(s.rest, half) > 0.95 * volume(s.rest, shape));
    CHECK(half.back() == mesh::Point{7, 7, 8});
    const LogVector vector = s.space.vector(shape, s.pool);
    const LogTerm term{&vector, 0.5};
    Points straight(shape.size());
    s.space.linear({&term, 1}, straight);
    CHECK(norm(straight[70] - 0.5 * (limb.positions[70] + shape[70])) < 1e-15);
  }
}

TEST_CASE("parts_of_large_models_that_are_tiny_or_collapse_move_without_jumps") {
  const mesh::Surface limb = tube(420, 200, 0.3, 6),
                      other = mapped(tube(30, 20, 0.1, 1), scaling(1, {2, 0, 0}));
  mesh::Surface all = together(limb, other);
  for (int i = 0; i < 50; ++i) all = together(all, mapped(box(), scaling(1e-5, {0.4, 0, 0.1 * i})));
  all.positions.push_back({0, 0, 1e20});  // has no triangle, and must not make the grid of clusters coarse
  Shapes s(all);
  REQUIRE(s.space.coarse());
  const auto turned = [&](double share) {
    Points points = mapped(all.positions, similarity({0, 0, 1}, share * 176 * degree));
    points.pop_back();
    return points;
  };
  Points shape = turned(1);
  shape.push_back(all.positions.back());
  Points half = s.share(shape, 0.5);
  half.pop_back();
  CHECK(largest_distance(half, turned(0.5)) < 1e-9);
  for (std::size_t v = 0; v < other.positions.size(); ++v) shape[limb.positions.size() + v] = {1, 1, 1};
  CHECK(largest_distance(s.share(shape, 0.9999999), shape) < 1e-5);
}

TEST_CASE("many_small_parts_rotate_like_a_single_one") {
  const mesh::Surface one = mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 0.3, 0}}, {{0, 1, 2}});
  const Points end = mapped(one.positions, similarity({0, 0, 1}, 150 * degree));
  mesh::Surface all;
  Points shape;
  std::vector<mesh::Triangle> triangles;
  for (std::uint32_t i = 0; 3 * i <= most_solved_vertices; ++i) {
    const Vec3 place{2.0 * (i % 170), 2.0 * (i / 170), 0.1 * (i % 7)};
    for (const auto& p : one.positions) all.positions.push_back(p + place);
    for (const auto& p : end) shape.push_back(p + place);
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Shapes s(mesh::from_triangles(all.positions, triangles)), alone(one);
  const Points half = centered(s.share(shape, 0.5), 3), expected = centered(alone.share(end, 0.5), 3);
  for (std::size_t v = 0; v < half.size(); ++v) REQUIRE(norm(half[v] - expected[v % 3]) < 1e-9);
}

TEST_CASE("the_density_of_vertices_does_not_move_a_part") {
  // Returns the shape halfway to a plate that is bent at x = 0, at x = -4, -3, ... 4, on a plate with
  // `dense` columns per unit at the right.
  const auto half_bent = [](std::uint32_t dense) {
    mesh::Surface plate;
    std::vector<mesh::Triangle> triangles;
    std::vector<std::uint32_t> whole;
    for (std::uint32_t i = 0; i <= 32 + 4 * dense; ++i) {
      const double x = i <= 32 ? i / 8.0 - 4 : (i - 32.0) / dense;
      if (x == std::round(x)) whole.push_back(2 * i);
      plate.positions.push_back({x, 0, 0});
      plate.positions.push_back({x, 1, 0});
      if (i > 0)
        for (const mesh::Triangle& t : {mesh::Triangle{0, 2, 1}, mesh::Triangle{1, 2, 3}})
          triangles.push_back({2 * i - 2 + t[0], 2 * i - 2 + t[1], 2 * i - 2 + t[2]});
    }
    Shapes s(mesh::from_triangles(plate.positions, triangles));
    Points shape = s.rest.positions;
    for (auto& p : shape)
      p = {p[0] * std::cos(30 * degree), p[1], std::abs(p[0]) * std::sin(30 * degree) + 2};
    const Points half = s.share(shape, 0.5);
    Points some;
    for (const auto v : whole) some.push_back(half[v]);
    return some;
  };
  CHECK(largest_distance(half_bent(8), half_bent(64)) < 0.005);
}

TEST_CASE("shapes_of_other_models_are_refused") {
  Shapes s(box());
  CHECK_THROWS_WITH_AS(s.space.vector(Points(7), s.pool), doctest::Contains("7 vertices"), base::Error);
  Points shape = s.rest.positions;
  shape[3][1] = std::nan("");
  CHECK_THROWS_WITH_AS(s.space.vector(shape, s.pool), doctest::Contains("vertex 3"), base::Error);
  mesh::Surface needle;
  needle.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK_THROWS_AS(Shapes(mesh::from_triangles(needle.positions, {{0, 1, 2}})), base::Error);
}

namespace {

struct Posed {
  std::shared_ptr<const Cage> cage;
  PoseSpace space;

  explicit Posed(mesh::Surface surface)
      : cage(std::make_shared<const Cage>(make_cage(std::move(surface)))), space(cage) {}

  const std::vector<mesh::Point>& rest() const { return cage->surface.positions; }
  Pose by(const Affine& map) const { return {mapped(rest(), map), {}}; }
  // Returns a pose between rest and `pose`.
  Pose share(const Pose& pose, double factor) const {
    const LogVector v = space.vector(pose);
    const std::array terms{LogTerm{&v, factor}};
    return space.pose(terms, space.logs().anchors_from(space.logs().at_rest(), terms));
  }
  Pose between(const LogVector& a, const LogVector& b, double t) const {
    const std::array terms{LogTerm{&a, 1 - t}, LogTerm{&b, t}};
    return space.pose(terms, space.logs().anchors_between(a, b));
  }
  double error(const Pose& pose, const std::vector<mesh::Point>& expected) const {
    return largest_distance(pose.positions, expected) / cage->diagonal;
  }
};

std::vector<mesh::Point> shaken(const Posed& p, double size) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, size * p.cage->diagonal);
  auto positions = p.rest();
  for (auto& x : positions) x = x + Vec3{normal(random), normal(random), normal(random)};
  return positions;
}

}  // namespace

TEST_CASE("half_of_a_half_turn_is_a_quarter_turn") {
  const Posed p(tube(9, 7, 0.3, 2));
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, -3}}) {
    for (const double angle : {180.0, 179.999, 90.0, 20.0, -150.0}) {
      const Pose half = p.share(p.by(similarity(axis, angle * degree)), 0.5);
      const auto quarter = mapped(p.rest(), similarity(axis, angle * degree / 2));
      // At 180 degrees, both directions of rotation are valid.
      const auto other = mapped(p.rest(), similarity(axis, -angle * degree / 2));
      const double error = p.error(half, quarter);
      CHECK((angle == 180 ? std::min(error, p.error(half, other)) : error) < 1e-12);
    }
  }
}

TEST_CASE("a_pose_comes_back_from_its_vector_even_if_it_collapses_or_mirrors") {
  const Posed p(tube(9, 7, 0.3, 2));
  std::vector<Pose> poses;
  for (const double size : {0.001, 0.01, 0.1, 1.0}) poses.push_back({shaken(p, size), {}});
  for (const Vec3& scale : {Vec3{1, 1, 0}, Vec3{-1, 1, 1}, Vec3{0, 0, 0}, Vec3{1, 1e-9, 1}})
    poses.push_back(p.by({{scale[0], 0, 0, 0, scale[1], 0, 0, 0, scale[2]}, {0.5, 0, 0}}));
  for (const Pose& pose : poses) {
    CHECK(p.error(p.share(pose, 1), pose.positions) < 1e-12);
    CHECK(p.error(p.share(pose, 0), p.rest()) == 0);
    for (const double share : {0.5, 1.5}) CHECK(all_finite(p.share(pose, share).positions));
  }
}

TEST_CASE("540_degrees_are_three_half_turns") {
  const Posed p(box());
  const double whole = 540 * degree;
  Pose pose = p.by(similarity({0, 0, 1}, whole));
  pose.turns = {{0, 0, whole}};
  for (const double share : {1.0 / 3, 2.0 / 3, 1.0, 0.25}) {
    const Pose part = p.share(pose, share);
    CHECK(p.error(part, mapped(p.rest(), similarity({0, 0, 1}, share * whole))) < 1e-12);
    CHECK(part.turns[0][2] == doctest::Approx(share * whole));
  }
}

TEST_CASE("a_pose_without_whole_turns_takes_those_nearest_to_the_preceding_pose") {
  const Posed p(box());
  LogVector before = p.space.vector(p.by({}));
  for (double angle = 0; angle <= 720; angle += 90) {
    const LogVector v = p.space.vector(p.by(similarity({0, 0, 1}, angle * degree)), before.turns);
    CHECK(v.turns[0][2] == doctest::Approx(angle * degree));
    if (angle > 0)
      CHECK(p.error(p.between(before, v, 0.5),
                    mapped(p.rest(), similarity({0, 0, 1}, (angle - 45) * degree))) < 1e-12);
    before = v;
  }
}

TEST_CASE("resting_parts_stay_and_a_limb_rotates_about_its_joint") {
  const Posed p(tube(9, 8, 0.3, 4));
  // The upper half of the tube rotates by 90 degrees about y.
  Pose pose{p.rest(), {}};
  const Affine turn = similarity({0, 1, 0}, 90 * degree);
  for (auto& x : pose.positions)
    if (x[2] > 0.1) x = turn(x);
  const LogVector rest = p.space.vector({p.rest(), {}}), posed = p.space.vector(pose);
  double tip = 0, least = 1e9;
  for (int i = 0; i <= 20; ++i) {
    const Pose part = p.between(rest, posed, i / 20.0);
    for (std::size_t v = 0; v < p.rest().size(); ++v)
      if (p.rest()[v][2] < -0.1) CHECK(norm(part.positions[v] - p.rest()[v]) < 2e-2);
    tip = norm(part.positions.back());
    least = std::min(least, tip);
  }
  // Linear interpolation would reduce the tip's distance to 1.41.
  CHECK(least > 1.9);
  const std::array half{LogTerm{&rest, 0.5}, LogTerm{&posed, 0.5}};
  CHECK(norm(p.space.linear(half).positions.back()) == doctest::Approx(std::sqrt(2.0)));
}

TEST_CASE("coincident_vertices_stay_together_between_poses") {
  const mesh::Surface surface = tube(5, 6, 0.5, 2);
  const Posed whole(surface), p(loose_triangles(surface));
  const auto bend = [](const mesh::Point& x) {
    return mesh::Point{x[0] + 0.3 * x[2] * x[2], x[1] + 0.2 * x[0] * x[2], x[2]};
  };
  const Pose half = p.share({mapped(p.rest(), bend), {}}, 0.5);
  const Pose expected = whole.share({mapped(whole.rest(), bend), {}}, 0.5);
  for (std::size_t e = 0; e < surface.triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(norm(half.positions[3 * e + k] - expected.positions[surface.triangles[e][k]]) < 0.01);
}

TEST_CASE("poses_far_from_rest_lose_only_rounding") {
  const Posed p(tube(9, 7, 0.3, 2));
  const Vec3 far{1e6, -3e5, 7e5};
  const LogVector a = p.space.vector(p.by({.shift = far}));
  const LogVector b = p.space.vector(p.by(similarity({0, 0, 1}, 120 * degree, 1, far)));
  CHECK(p.error(p.between(a, b, 0.5), mapped(p.rest(), similarity({0, 0, 1}, 60 * degree, 1, far))) < 1e-9);
  CHECK_THROWS(p.space.vector({{{0, 0, 0}}, {}}));  // wrong number of vertices
}

TEST_CASE("a_posed_cage_makes_its_whole_turns_about_any_axis") {
  const Posed p(tube(9, 7, 0.3, 2));
  const auto posed = shaken(p, 0.02);
  const Vec3 middle = pose::middle(posed);
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.6, 0, -0.8}}) {
    for (const double count : {1.0, -2.0}) {
      const LogVector from = p.space.vector({posed, {{0, 0, 0}}});
      const LogVector to = p.space.vector({posed, {count * 360 * degree * axis}});
      for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        auto expected = posed;
        const Affine turn = similarity(axis, share * count * 360 * degree);
        for (Vec3& x : expected) x = middle + turn(x - middle);
        // About 2 % of the shape is not represented by logs. This part does not rotate between the keys.
        const bool is_key = share == 0 || share == 1;
        CHECK(p.error(p.between(from, to, share), expected) < (is_key ? 1e-12 : 0.04));
      }
    }
  }
}
