#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "cages/make.h"
#include "foreign/read.h"
#include "formats/text_writer.h"
#include "formats/write.h"
#include "library/arguments.h"
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
    refuse(what, "starts does not match corners", "let starts ascend from 0 to the number of corners");
  for (std::size_t f = 0; f + 1 < starts.size(); ++f)
    if (starts[f + 1] < starts[f] + 3)
      refuse(what, "face " + std::to_string(f) + " has fewer than three corners", "remove this face");
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    if (mesh.corners[c] >= mesh.vertices.size())
      refuse(what,
             "a face refers to vertex " + std::to_string(mesh.corners[c]) + ", the mesh has " +
                 std::to_string(mesh.vertices.size()),
             "use vertex indices from 0");
}

void check_points(std::span<const mesh::Point> points, std::size_t vertices, const char* what) {
  if (points.size() != vertices)
    refuse(
        what,
        "it has " + base::counted(points.size(), "place") + " for " + std::to_string(vertices) + " vertices",
        "pass one place for each vertex");
  for (std::size_t v = 0; v < points.size(); ++v)
    for (const double x : points[v])
      if (!(std::abs(x) <= mesh::largest_coordinate))
        refuse(what, "vertex " + std::to_string(v) + " has a coordinate that is not finite or above 1e100",
               "use finite coordinates");
}

void check_deformable(std::span<const mesh::Point> points, double least, const char* what) {
  const mesh::Bounds box = mesh::bounds(points);
  const double extent = mesh::largest_abs(box.high - box.low);
  const double farthest = std::max(mesh::largest_abs(box.low), mesh::largest_abs(box.high));
  if (farthest > most_deformable)
    refuse(what, "it has a coordinate of size " + plain(farthest), "scale it to stay within 1e60");
  if (extent > 0 && extent < least)
    refuse(what, "its size is " + plain(extent), "scale it to a size of 1e-60 or more");
}

}  // namespace

std::vector<mesh::Point> inside(std::span<const Point3> points) {
  return {points.begin(), points.end()};
}

std::vector<Point3> outside(std::span<const mesh::Point> points) {
  return {points.begin(), points.end()};
}

void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice) {
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!formats::is_place(points[v], std::numeric_limits<double>::max()))
      refuse(what, "vertex " + std::to_string(v) + " would have a coordinate that is not finite", advice);
}

std::vector<mesh::Point> deformable_points(std::span<const double> numbers, std::size_t vertices,
                                           const char* what) {
  if (numbers.size() % 3 != 0)
    refuse(what, "it has " + std::to_string(numbers.size()) + " numbers",
           "pass three numbers for each vertex");
  std::vector<mesh::Point> points(numbers.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] = {numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]};
  return deformable(std::move(points), vertices, what);
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

std::vector<mesh::Point> deformable(std::vector<mesh::Point> points, std::size_t vertices, const char* what) {
  check_points(points, vertices, what);
  check_deformable(points, 0, what);
  return points;
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

struct FileContent : formats::ReadResult {};

Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes) {
  const auto content = std::make_shared<FileContent>(FileContent{foreign::read(file)});
  if (notes) *notes = content->warnings;
  Mesh mesh = library::mesh_of(content->surface);
  mesh.file = content;
  return mesh;
}

void write_mesh(const std::filesystem::path& file, const Mesh& mesh, std::vector<std::string>* notes) {
  const mesh::Surface surface = library::surface_of(mesh, "the mesh");
  const FileContent* const content = mesh.file.get();
  const bool same = content && content->surface.positions.size() == mesh.vertices.size() &&
                    content->surface.corners == mesh.corners &&
                    content->surface.polygon_starts == mesh.starts;
  if (notes) notes->clear();
  if (!same) return formats::write(file, surface);
  const bool rest = surface.positions == content->surface.positions;  // else splats would not follow
  auto losses = formats::write(file,
                               {content->surface,
                                surface.positions,
                                {},
                                content->attributes.get(),
                                rest ? content->splats.get() : nullptr},
                               content->original.get(), {});
  if (notes) *notes = std::move(losses);
}

Mesh make_cage(const Mesh& model, const CageWish& asked, const Watch& watch) {
  cages::Wish wish;
  wish.kind = library::named<cages::Kind>(asked.kind, "kind");
  wish.symmetry = library::named<cages::Symmetry>(asked.symmetry, "symmetry");
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  using library::check_range;
  check_range("triangles", count(asked.triangles), count(cages::least_triangles),
              count(cages::most_triangles));
  check_range("margin", asked.margin, cages::least_margin, cages::most_margin);
  check_range("gap", asked.gap, 0, cages::most_gap);
  for (const std::size_t cells : asked.cells) check_range("cells", count(cells), 1, count(cages::most_cells));
  wish.triangles = asked.triangles;
  wish.margin = asked.margin;
  wish.gap = asked.gap;
  wish.quads = asked.quads;
  wish.cells = asked.cells;
  wish.own_axes = asked.own_axes;
  const mesh::Surface surface = library::surface_of(model, "the model");
  return library::watched(watch, [&](base::Progress* progress) {
    base::WorkerPool pool;
    return library::mesh_of(cages::make(surface, wish, pool, progress).surface);
  });
}

}  // namespace viete
