#include "mesh/normals.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

std::vector<Point> normals_of(const Surface& s) {
  std::vector<Point> normals(s.positions.size());
  const Adjacency around = vertex_triangles(s.positions.size(), s.triangles);
  vertex_normals(s.positions, s.triangles, around, 0, normals.size(), normals);
  return normals;
}

// Rotates a point by 90 degrees about x, then moves the point along x.
Point turned_about_x(const Point& p) {
  return {p[0] + 1, -p[2], p[1]};
}

std::vector<Point> turned(const std::vector<Point>& points) {
  std::vector<Point> all;
  for (const Point& p : points) all.push_back(turned_about_x(p));
  return all;
}

}  // namespace

TEST_CASE("normals_of_a_sphere_point_outward_at_every_scale") {
  for (const double scale : {1e-70, 1e-30, 1.0, 1e30, 1e70}) {
    const Surface s = test::sphere(3);
    const auto normals = normals_of(test::moved(s, scale));
    for (std::size_t v = 0; v < normals.size(); ++v) {
      CHECK(dot(normals[v], normals[v]) == doctest::Approx(1).epsilon(1e-14));
      CHECK(dot(normals[v], s.positions[v]) > 0.995);
    }
  }
}

TEST_CASE("normals_are_weighted_by_area") {
  // Two perpendicular triangles at vertex 0. The triangle in the xy plane is three times as large.
  const Surface s = from_triangles({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const Point n = normals_of(s)[0];
  CHECK(n[0] == doctest::Approx(1 / std::sqrt(10.0)).epsilon(1e-15));
  CHECK(n[1] == 0);
  CHECK(n[2] == doctest::Approx(3 / std::sqrt(10.0)).epsilon(1e-15));
}

TEST_CASE("vertex_without_area_has_a_default_normal") {
  const Surface s = from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}}, {{0, 1, 2}, {0, 0, 1}});
  for (const Point& n : normals_of(s)) CHECK(n == Point{0, 0, 1});
}

TEST_CASE("normals_of_a_file_follow_the_deformation_and_stay_split") {
  Surface s = test::cube();
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> corner_normal;
  for (std::size_t p = 0; p < s.polygon_count(); ++p) {
    const auto corner = [&](std::size_t i) { return s.positions[s.corners[s.polygon_starts[p] + i]]; };
    normals.push_back(0.25 * cross(corner(1) - corner(0), corner(2) - corner(0)));
    corner_normal.insert(corner_normal.end(), 4, static_cast<std::uint32_t>(p));
  }
  CHECK(deformed_normals(s, s.positions, normals, corner_normal) == normals);

  // A shear of z by x, a stretch along x, and a rotation about z. The cofactors transform the normals.
  const double cosine = std::cos(0.7), sine = std::sin(0.7);
  const auto map = [&](const Point& p) {
    const Point sheared{2 * p[0], p[1], p[2] + 0.5 * p[0]};
    return Point{cosine * sheared[0] - sine * sheared[1], sine * sheared[0] + cosine * sheared[1],
                 sheared[2]};
  };
  std::vector<Point> posed;
  for (const Point& p : s.positions) posed.push_back(map(p));
  const auto moved = deformed_normals(s, posed, normals, corner_normal);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3& n = normals[i];
    const Vec3 across{n[1], n[2], n[0]}, other = cross(n, across);
    const Vec3 expected = cross(map(across), map(other));
    CHECK(norm(moved[i] - (1 / norm(expected)) * expected) < 1e-14);
  }
  const auto tangents = deformed_tangents(s, posed, {{Vec3{1, 0, 0}}}, std::vector<std::uint32_t>(24, 0));
  CHECK(norm(tangents[0]) == doctest::Approx(1));
}

TEST_CASE("rotation_rotates_normals_that_lean_from_their_faces") {
  const Surface s = test::sphere(2);
  std::vector<Vec3> normals;
  std::vector<Point> posed;
  for (const Point& p : s.positions) {
    const Vec3 leaning = p + Vec3{0.1, 0.2, -0.1};
    normals.push_back((1 / norm(leaning)) * leaning);
    posed.push_back({-p[1], p[0], p[2]});
  }
  const auto moved = deformed_normals(s, posed, normals, s.corners);
  for (std::size_t i = 0; i < normals.size(); ++i)
    CHECK(norm(moved[i] - Vec3{-normals[i][1], normals[i][0], normals[i][2]}) < 1e-13);
}

TEST_CASE("equal_normals_of_vertices_at_one_place_stay_equal") {
  Surface two;  // two squares; their common edge has two copies of its vertices
  two.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  two.corners = {0, 1, 2, 3, 4, 5, 6, 7};
  two.polygon_starts = {0, 4, 8};
  triangulate(two);
  std::vector<Point> posed = two.positions;
  for (const std::size_t v : {5, 6}) posed[v] = {1, posed[v][1], 1};  // the right square stands
  const Vec3 up{0, 0, 1}, left{-1, 0, 0};
  const auto normals = deformed_normals(two, posed, std::vector<Vec3>(8, up), two.corners);
  for (const auto& [v, copy] : {std::pair(1, 4), {2, 7}}) {
    CHECK(normals[v] == normals[copy]);
    CHECK(normals[v][2] > 0.4);
    CHECK(normals[v][0] < -0.4);
  }
  CHECK(normals[0] == up);
  CHECK(norm(normals[5] - left) < 1e-14);
  const std::vector<std::uint32_t> of_faces = {0, 0, 0, 0, 1, 1, 1, 1};
  CHECK(norm(deformed_normals(two, posed, std::vector<Vec3>(2, up), of_faces)[1] - left) < 1e-14);
  const std::vector<Point> collapsed(8, Point{0, 0, 0});
  CHECK(deformed_normals(two, collapsed, std::vector<Vec3>(8, up), two.corners).size() == 8);
  for (const std::size_t v : {4, 5, 6, 7}) posed[v][0] += 0.5;
  CHECK(deformed_normals(two, posed, std::vector<Vec3>(8, up), two.corners)[1] == up);
}

TEST_CASE("offsets_turn_with_the_surface_and_those_of_positions_grow_with_it") {
  const Surface s = test::sphere(1);
  std::vector<Point> posed;
  for (const Point& p : s.positions) posed.push_back(3.0 * turned_about_x(p));
  const std::vector<Vec3> offsets(s.positions.size(), Vec3{0.25, 0.5, 0});
  for (const auto& [kind, scale] : {std::pair(OffsetKind::positions, 3.0), {OffsetKind::directions, 1.0}})
    for (const auto& o : deformed_offsets(s, posed, offsets, kind, s.corners))
      CHECK(norm(o - scale * Vec3{0.25, 0, 0.5}) < 1e-14);
}

TEST_CASE("normals_without_triangles_rotate_with_nearby_geometry") {
  const Vec3 up{0, 0, 1}, is_then{0, -1, 0};
  const auto near = [](const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-14; };
  Surface points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}, {3, 1, 0}};
  const std::vector<Vec3> normals(5, up);
  for (const auto& n : deformed_normals(points, turned(points.positions), normals, {},
                                        first_numbers(points.positions.size())))
    CHECK(near(n, is_then));
  CHECK(deformed_normals(points, points.positions, normals, {}, first_numbers(points.positions.size())) ==
        normals);
  for (const auto& t : deformed_tangents(points, turned(points.positions), normals, {},
                                         first_numbers(points.positions.size())))
    CHECK(near(t, is_then));

  Surface line;  // a line along y: the rotation about the line is undetermined
  line.positions = {{0, 0, 0}, {0, 1, 0}, {0, 3, 0}};
  for (const auto& n : deformed_normals(line, turned(line.positions), std::vector<Vec3>(3, up), {},
                                        first_numbers(line.positions.size())))
    CHECK(near(n, is_then));

  // A separate vertex near a triangle, and a face without area. Both rotate with the triangle.
  Surface mixed = from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {2, 0, 0}, {3, 0, 0}},
                                 {{0, 1, 2}, {1, 4, 5}});
  const auto now = turned(mixed.positions);
  for (const auto& n : deformed_normals(mixed, now, std::vector<Vec3>(6, up), mixed.corners,
                                        first_numbers(mixed.positions.size())))
    CHECK(near(n, is_then));
  const std::vector<std::uint32_t> a_face_each = {0, 0, 0, 1, 1, 1};
  for (const auto& n : deformed_normals(mixed, now, std::vector<Vec3>(2, up), a_face_each))
    CHECK(near(n, is_then));

  // A face with a corner in the middle of a side.
  Surface side;
  side.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  side.corners = {0, 1, 2, 3, 4};
  side.polygon_starts = {0, 5};
  triangulate(side);
  for (const auto& n : deformed_normals(side, turned(side.positions), std::vector<Vec3>(5, up), side.corners))
    CHECK(near(n, is_then));
}
