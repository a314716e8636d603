#include "weights/part_coupling.h"

#include "deform/bound.h"
#include "formats/read.h"
#include "mesh/edge_paths.h"
#include "mesh/repair.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"
#include "pose/pose_file.h"
#include "support/caged_shapes.h"
#include "support/data.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting plates{.weights = Weights::biharmonic};

// Separates the triangles of a surface. Moves each corner by at most `moved`.
mesh::Surface soup_of(const mesh::Surface& surface, double moved) {
  Random random(7);
  return mapped(loose_triangles(surface), [&](const Vec3& x) { return x + random.vector(moved); });
}

Binding bound(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, int threads = 2) {
  base::WorkerPool pool(threads);
  return bind(model, cage, weighting, pool);
}

// Returns the largest difference between the weights of vertex v in `a` and vertex w in `b`.
double apart(const Binding& a, std::size_t v, const Binding& b, std::size_t w) {
  double most = 0;
  for (std::size_t h = 0; h < a.handles; ++h)
    most = std::max(most, std::abs(a.weights[v * a.handles + h] - b.weights[w * b.handles + h]));
  return most;
}

std::size_t nearest(const mesh::Surface& surface, const mesh::Point& p) {
  const auto at = std::ranges::min_element(surface.positions, {}, [&](const Vec3& x) { return norm(x - p); });
  return static_cast<std::size_t>(at - surface.positions.begin());
}

double most_apart_from_nearest(const Binding& b, const mesh::Surface& inner, const mesh::Surface& outer) {
  double most = 0;
  for (std::size_t i = 0; i < inner.positions.size(); ++i) {
    const std::size_t j = nearest(outer, inner.positions[i]);
    most = std::max(most, apart(b, i, b, inner.positions.size() + j));
  }
  return most;
}

std::vector<Coupling> couplings_of(const mesh::Surface& surface, int threads = 2) {
  base::WorkerPool pool(threads);
  const mesh::Surface joined = mesh::welded(surface);
  const PartedSurface parted = parted_surface(joined, intrinsic_laplacian(joined).masses);
  return parted.joined(part_couplings(parted.surface, mesh::EdgePaths(parted.surface), parted.masses, pool));
}

double distance_at(const Coupling& coupling, const std::vector<mesh::Point>& p) {
  const auto& [vertex, t, shares, strength] = coupling;
  return norm(p[vertex] - (shares[0] * p[t[0]] + shares[1] * p[t[1]] + shares[2] * p[t[2]]));
}

// Returns the largest change of a distance between the two ends of a coupling.
double most_changed(const std::vector<Coupling>& couplings, const std::vector<mesh::Point>& rest,
                    const std::vector<mesh::Point>& posed) {
  double most = 0;
  for (const Coupling& c : couplings)
    most = std::max(most, std::abs(distance_at(c, posed) - distance_at(c, rest)));
  return most;
}

// Returns the number of vertices of each part, at the part's number.
std::vector<std::size_t> sizes_of(mesh::UnionFind& parts, std::size_t vertices) {
  std::vector<std::size_t> sizes(vertices, 0);
  for (std::uint32_t v = 0; v < vertices; ++v) ++sizes[parts.find(v)];
  return sizes;
}

// Returns for each vertex whether it is in the part with most of the vertices.
std::vector<bool> in_head(const mesh::Surface& model, mesh::UnionFind& parts) {
  std::vector<bool> result;
  const auto sizes = sizes_of(parts, model.positions.size());
  for (std::uint32_t v = 0; v < model.positions.size(); ++v)
    result.push_back(2 * sizes[parts.find(v)] > model.positions.size());
  return result;
}

// Scales the eyes about the means of their vertices.
mesh::Surface with_eyes_of_size(double size, mesh::Surface model) {
  auto parts = mesh::parts_by_triangles(model.positions.size(), model.triangles);
  const auto head = in_head(model, parts);
  const auto sizes = sizes_of(parts, model.positions.size());
  std::vector<Vec3> means(sizes.size(), Vec3{0, 0, 0});
  for (std::uint32_t v = 0; v < head.size(); ++v) {
    const auto part = parts.find(v);
    means[part] = means[part] + (1.0 / static_cast<double>(sizes[part])) * model.positions[v];
  }
  for (std::uint32_t v = 0; v < head.size(); ++v) {
    const Vec3& mean = means[parts.find(v)];
    if (!head[v]) model.positions[v] = mean + size * (model.positions[v] - mean);
  }
  return model;
}

// Returns the nearest point of the head for each vertex of an eye within 1.5 % of the diagonal.
std::vector<Coupling> eyes_beside_head(const mesh::Surface& model) {
  auto parts = mesh::parts_by_triangles(model.positions.size(), model.triangles);
  const auto head = in_head(model, parts);
  const auto& p = model.positions;
  std::vector<Coupling> beside;
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    if (head[v]) continue;
    double least = std::pow(0.015 * mesh::bounds(p).diagonal(), 2);
    Coupling nearest{v, {}, {}, 0};
    for (const auto& t : model.triangles) {
      if (!head[t[0]]) continue;
      const auto closest = mesh::closest_on_triangle(p[v], p[t[0]], p[t[1]], p[t[2]]);
      if (closest.squared_distance > least) continue;
      least = closest.squared_distance;
      nearest = {v, t, closest.barycentric, 1};
    }
    if (nearest.strength > 0) beside.push_back(nearest);
  }
  return beside;
}

// Returns a grid with vertices at place(u, v). u is between `from` and `to`. v is an angle over a full turn.
mesh::Surface rows_around(std::uint32_t rows, std::uint32_t sides, double from, double to,
                          const std::function<Vec3(double, double)>& place) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i < (rows + 1) * sides; ++i)
    p.push_back(
        place(std::lerp(from, to, double(i / sides) / rows), 2 * std::numbers::pi * (i % sides) / sides));
  for (std::uint32_t i = 0; i < rows * sides; ++i) {
    const std::uint32_t next = i % sides + 1 < sides ? i + 1 : i + 1 - sides;
    t.push_back({i, i + sides, next});
    t.push_back({next, i + sides, next + sides});
  }
  return mesh::from_triangles(p, t);
}

// Returns a head of three parts and two eyes. Gaps in diagonals: 0.004 between parts, `gap` around eyes.
mesh::Surface head(double gap, double eye) {
  const Vec3 half{0.85, 0.75, 1};
  const double diagonal = 2 * norm(half), seam = 0.002 * diagonal, socket = eye + gap * diagonal;
  const auto on_sphere = [](double u, double v) {
    return Vec3{std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)};
  };
  const auto skin = [&](double u, double v) {
    const Vec3 d = on_sphere(u, v);
    return Vec3{half[0] * d[0], half[1] * d[1], half[2] * d[2]};
  };
  std::vector<std::pair<Vec3, Vec3>> eyes;  // the center and the outward direction of each eye
  for (const double side : {-0.45, 0.45}) {
    const Vec3 p = skin(1.4, side), n{p[0] / (half[0] * half[0]), p[1] / (half[1] * half[1]), p[2]};
    eyes.push_back({p - (0.2 * eye / norm(n)) * n, (1 / norm(n)) * n});
  }
  const auto with_sockets = [&](double u, double v) {
    Vec3 p = skin(u, v);
    for (const auto& [center, outward] : eyes) {
      const Vec3 from = p - center, across = from - dot(from, outward) * outward;
      if (norm(from) <= socket)
        p = center + across - std::sqrt(socket * socket - dot(across, across)) * outward;
    }
    return p;
  };
  mesh::Surface model = together(rows_around(4, 16, 0, 0.8 - seam, with_sockets),
                                 rows_around(7, 22, 0.8 + seam, 2 - seam, with_sockets));
  model = together(model, rows_around(5, 18, 2 + seam, 2.7, with_sockets));
  for (const auto& [center, outward] : eyes)
    model = together(model, rows_around(6, 12, 0, std::numbers::pi, [&](double u, double v) {
                       return center + eye * on_sphere(u, v + 0.1);
                     }));
  return model;
}

}  // namespace

TEST_CASE("a_model_of_one_part_that_nowhere_touches_itself_has_no_couplings") {
  CHECK(couplings_of(tube(20, 16, 0.5, 3)).empty());
}

TEST_CASE("a_tube_in_a_tube_takes_weights_like_those_of_the_tube_around_it") {
  const auto outer = tube(30, 24, 0.5, 3);
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  for (const double radius : {0.49, 0.4, 0.3}) {
    CAPTURE(radius);
    const auto inner = tube(26, 20, radius, 2.9);
    const auto model = together(inner, outer);
    CHECK(most_apart_from_nearest(bound(model, cage, plates), inner, outer) < 0.01 + 0.3 * (0.5 - radius));
  }
}

TEST_CASE("eyes_stay_in_their_sockets_about_as_well_as_with_mean_value_coordinates") {
  const Twist twist{2, {0, 0, 0}, -1.2, 1.2, -100 * degree, 100 * degree};
  const auto bent = [](const Vec3& p) {  // bends by 90 degrees
    const double radius = 2.6 / (0.5 * std::numbers::pi), angle = p[2] / radius;
    return Vec3{radius - (radius - p[0]) * std::cos(angle), p[1], (radius - p[0]) * std::sin(angle)};
  };
  for (const double gap : {0.002, 0.005, 0.01})
    for (const double radius : {0.1, 0.12, 0.25, 0.3}) {
      CAPTURE(gap);
      CAPTURE(radius);
      const auto model = head(gap, radius),
                 cage = tube(radius < 0.2 ? 6 : 14, radius < 0.2 ? 8 : 16, 1.05, 2.4);
      const auto beside = couplings_of(model);
      CHECK(beside.size() > 20);
      Bound smooth(model, cage, biharmonics), mean_value(model, cage, mean_values, 2, Blend::linear);
      const auto apart = [&](Bound& b, const auto& map) {
        return most_changed(beside, model.positions, b.deform(b.pose(map)));
      };
      CHECK(apart(smooth, twist) < 1.6 * apart(mean_value, twist));
      CHECK(apart(smooth, bent) < 1.6 * apart(mean_value, bent));
    }
}

// Suzanne's eyes touch the head. One corner of each eye is 1.5 % of the diagonal away from the head.
TEST_CASE("the_eyes_of_suzanne_stay_in_their_sockets" * doctest::test_suite(if_present)) {
  const auto folder = shared_data("suzanne");
  if (folder.empty()) return;
  const auto cage = std::make_shared<const Cage>(make_cage(formats::read(folder / "cage.obj").surface));
  const auto suzanne = formats::read(folder / "mesh.obj").surface;
  base::WorkerPool pool(2);
  for (const double size : {1.0, 1.05}) {
    CAPTURE(size);
    const auto model = with_eyes_of_size(size, mesh::split_unsettled(suzanne, 0).surface);
    const auto beside = eyes_beside_head(model);
    CHECK(beside.size() == (size > 1 ? 28 : 24));
    for (const auto* const name : {"pose_twist200.obj", "pose_bend.obj"}) {
      CAPTURE(name);
      std::vector<std::string> warnings;
      const Pose pose = read_pose(folder / name, *cage, warnings);
      const auto apart = [&](Preset preset) {
        const auto posed = deform_exactly(model, cage, deformer_of(preset), pose, sym3::Method::fast, pool);
        return most_changed(beside, model.positions, posed.positions);
      };
      const double most = 1.6 * apart(Preset::mean_value);
      CHECK(apart(Preset::smooth) < most);
      CHECK(apart(Preset::arap) < most);
    }
  }
}

TEST_CASE("parts_that_share_a_single_vertex_are_coupled_like_parts_apart") {
  const auto outer = tube(30, 24, 0.5, 3);
  const auto inner = mapped(tube(26, 20, 0.48, 2.9), [&](const Vec3& x) {
    return norm(x - Vec3{0.48, 0, 1.45}) < 1e-9 ? outer.positions[29 * 24] : x;
  });
  const auto model = together(inner, outer);
  CHECK(mesh::welded(model).triangles != model.triangles);
  CHECK(couplings_of(model).size() > 500);
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  CHECK(most_apart_from_nearest(bound(model, cage, plates), inner, outer) < 0.02);
}

TEST_CASE("a_coarse_part_is_coupled_to_the_nearest_points_and_not_to_the_nearest_vertices") {
  // A large triangle, and a small triangle above the middle of the large one.
  const auto model = mesh::from_triangles(
      {{-2, -1, 0}, {2, -1, 0}, {0, 2, 0}, {-0.1, -0.1, 0.01}, {0.1, -0.1, 0.01}, {0, 0.1, 0.01}},
      {{0, 1, 2}, {3, 4, 5}});
  const auto couplings = couplings_of(model);
  REQUIRE(couplings.size() == 3);
  for (const auto& [vertex, t, shares, strength] : couplings) {
    const auto& p = model.positions;
    const Vec3 point = shares[0] * p[t[0]] + shares[1] * p[t[1]] + shares[2] * p[t[2]];
    CHECK(vertex >= 3);
    CHECK(norm(p[vertex] - point) == doctest::Approx(0.01));
  }
}

TEST_CASE("couplings_weaken_with_distance_and_end_at_two_percent_of_the_diagonal") {
  const auto tile =
      mesh::from_triangles({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  double previous = 1e9;
  for (const double gap : {0.01, 0.02, 0.04, 0.056, 0.057}) {  // the diagonal is 2.83
    CAPTURE(gap);
    const auto other = mapped(tile, [&](const Vec3& x) { return x + Vec3{0, 0, gap}; });
    const auto couplings = couplings_of(together(tile, other));
    CHECK(couplings.size() == (gap < 0.0565 ? 8 : 0));
    for (const Coupling& c : couplings) CHECK(c.strength < 0.6 * previous);
    if (!couplings.empty()) previous = couplings[0].strength;
  }
}

TEST_CASE("a_triangle_soup_has_the_weights_of_its_surface") {
  Random random(3);  // makes nearest vertices unique
  const auto whole = mapped(tube(24, 18, 0.5, 3), [&](const Vec3& x) { return x + random.vector(0.01); });
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  for (const Weighting& weighting : {harmonics, biharmonics}) {
    const Binding expected = bound(whole, cage, weighting);
    for (const double moved : {0.0, 1e-7, 1e-5, 1e-3}) {
      CAPTURE(moved);
      if (moved > 0 && weighting == harmonics) continue;
      const Binding soup = bound(soup_of(whole, moved), cage, weighting);
      double most = 0;
      for (std::size_t i = 0; i < soup.vertices; ++i)
        most = std::max(most, apart(soup, i, expected, whole.triangles[i / 3][i % 3]));
      CHECK(most < (moved > 0 ? 0.15 : 1e-9));
    }
  }
}

TEST_CASE("folds_that_touch_are_coupled_and_neighbours_along_the_surface_are_not") {
  // A strip that folds back. The upper half is 0.0005 above the lower half.
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i <= 20; ++i) {
    const double x = 0.1 * std::min(i, 20 - i), z = i > 10 ? 0.0005 : 0;
    p.push_back({x, 0, z});
    p.push_back({x, 1, z});
    if (i == 0) continue;
    const std::uint32_t a = 2 * i - 2;
    t.push_back({a, a + 1, a + 2});
    t.push_back({a + 2, a + 1, a + 3});
  }
  const auto couplings = couplings_of(mesh::from_triangles(p, t));
  CHECK(couplings.size() == 2 * 2 * 10);
  for (const auto& [a, triangle, shares, strength] : couplings) {
    const auto b = triangle[0];
    CHECK(a / 2 + b / 2 == 20);
    CHECK(a % 2 == b % 2);
    CHECK(shares[0] == 1);
    CHECK(strength > 0);
  }
}

TEST_CASE("couplings_and_weights_of_many_parts_do_not_depend_on_the_number_of_threads") {
  const auto model = soup_of(tube(16, 12, 0.5, 3), 1e-3);
  const Cage cage = make_cage(tube(4, 6, 0.7, 3.4));
  const auto one = couplings_of(model, 1), four = couplings_of(model, 4);
  REQUIRE(one.size() == four.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    CHECK((one[i].vertex == four[i].vertex && one[i].triangle == four[i].triangle &&
           one[i].shares == four[i].shares && one[i].strength == four[i].strength));
  CHECK(bound(model, cage, plates, 1).weights == bound(model, cage, plates, 4).weights);
}

TEST_CASE("harmonic_weights_of_several_parts_stay_between_0_and_1") {
  const auto model = together(tube(20, 16, 0.5, 3), tube(18, 14, 0.45, 2.9));
  const Binding b = bound(model, make_cage(tube(4, 6, 0.7, 3.4)), {.weights = Weights::harmonic});
  for (const double w : b.weights) CHECK((w > -1e-9 && w < 1 + 1e-9));
}
