#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "cages/make.h"
#include "library/surfaces.h"
#include "library/watched.h"
#include "library/words.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "mesh/triangulation.h"

namespace viete {

namespace library {

namespace {

[[noreturn]] void refuse(const char* what, const std::string& problem, const char* advice) {
  throw base::Error(what, problem, advice);
}

void check_faces(const Mesh& mesh, const char* what) {
  const auto& starts = mesh.starts;
  const bool whole =
      starts.empty() ? mesh.corners.empty() : starts.front() == 0 && starts.back() == mesh.corners.size();
  if (!whole)
    refuse(what, "starts does not match corners", "start at 0, ascend, and end at the number of corners");
  for (std::size_t f = 0; f + 1 < starts.size(); ++f)
    if (starts[f + 1] < starts[f] + 3)
      refuse(what, "face " + std::to_string(f) + " has fewer than three corners", "remove it");
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    if (mesh.corners[c] >= mesh.vertices.size())
      refuse(what,
             "a face refers to vertex " + std::to_string(mesh.corners[c]) + ", the mesh has " +
                 std::to_string(mesh.vertices.size()),
             "vertex indices start at 0");
}

}  // namespace

std::vector<mesh::Point> inside(std::span<const Point3> points) {
  std::vector<mesh::Point> all(points.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = {points[v][0], points[v][1], points[v][2]};
  return all;
}

std::vector<Point3> outside(std::span<const mesh::Point> points) {
  std::vector<Point3> all(points.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = {points[v][0], points[v][1], points[v][2]};
  return all;
}

void check_points(std::span<const mesh::Point> points, std::size_t vertices, const char* what) {
  if (points.size() != vertices)
    refuse(
        what,
        "it has " + base::counted(points.size(), "place") + " for " + std::to_string(vertices) + " vertices",
        "pass one per vertex");
  for (std::size_t v = 0; v < points.size(); ++v)
    for (const double x : points[v])
      if (!(std::abs(x) <= mesh::largest_coordinate))
        refuse(what, "vertex " + std::to_string(v) + " has a coordinate that is not finite, or beyond 1e100",
               "use finite coordinates");
}

void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice) {
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!mesh::is_place(points[v], std::numeric_limits<double>::max()))
      refuse(what, "vertex " + std::to_string(v) + " would have a coordinate that is not finite", advice);
}

std::vector<mesh::Point> points_of(std::span<const double> numbers, std::size_t vertices, const char* what) {
  if (numbers.size() % 3 != 0)
    refuse(what, "it has " + std::to_string(numbers.size()) + " numbers", "pass three per vertex");
  std::vector<mesh::Point> points(numbers.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] = {numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]};
  check_points(points, vertices, what);
  return points;
}

mesh::Surface surface_of(const Mesh& mesh, const char* what) {
  check_faces(mesh, what);
  mesh::Surface surface;
  surface.positions = inside(mesh.vertices);
  check_points(surface.positions, surface.positions.size(), what);
  surface.corners = mesh.corners;
  surface.polygon_starts = mesh.starts;
  if (surface.polygon_starts.empty()) surface.polygon_starts = {0};
  mesh::triangulate(surface);
  return surface;
}

void check_deformable(std::span<const mesh::Point> points, double least, const char* what) {
  const mesh::Bounds box = mesh::bounds(points);
  const double extent = mesh::largest_abs(box.high - box.low);
  const double farthest = std::max(mesh::largest_abs(box.low), mesh::largest_abs(box.high));
  if (farthest > most_deformable)
    refuse(what, "it has a coordinate of size " + plain(farthest), "scale it so that it stays within 1e60");
  if (extent > 0 && extent < least)
    refuse(what, "it is " + plain(extent) + " in size", "scale it to 1e-60 or more");
}

mesh::Surface deformable_surface_of(const Mesh& mesh, const char* what) {
  mesh::Surface surface = surface_of(mesh, what);
  check_deformable(surface.positions, 1e-60, what);
  return surface;
}

Mesh mesh_of(const mesh::Surface& surface) {
  return {outside(surface.positions), surface.corners, surface.polygon_starts};
}

}  // namespace library

Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes) {
  mesh::ReadResult read = mesh::read(file);
  if (notes) *notes = std::move(read.warnings);
  return library::mesh_of(read.surface);
}

void write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  mesh::write(file, library::surface_of(mesh, "the mesh"));
}

Mesh make_cage(const Mesh& model, const CageWish& asked, const Watch& watch) {
  cages::Wish wish;
  wish.kind = library::named(cages::all_kinds(), asked.kind, "kind");
  wish.symmetry = library::named(cages::all_symmetries(), asked.symmetry, "symmetry");
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  using library::check_range;
  check_range("triangles", count(asked.triangles), count(cages::least_triangles),
              count(cages::most_triangles));
  check_range("margin", asked.margin, cages::least_margin, cages::most_margin);
  check_range("gap", asked.gap, 0, cages::most_gap);
  for (const std::size_t cells : asked.cells) check_range("cells", count(cells), 1, count(cages::most_cells));
  wish.triangles = asked.triangles, wish.margin = asked.margin, wish.gap = asked.gap;
  wish.quads = asked.quads, wish.cells = asked.cells, wish.own_axes = asked.own_axes;
  const mesh::Surface surface = library::surface_of(model, "the model");
  return library::watched(watch, [&](base::Progress* progress) {
    base::WorkerPool pool;
    return library::mesh_of(cages::make(surface, wish, pool, progress).surface);
  });
}

}  // namespace viete
