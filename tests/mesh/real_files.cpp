// Real files written again, also read by OpenMesh for comparison.
#include <doctest/doctest.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <cmath>

#include "mesh/shapes.h"
#include "support/data.h"

using namespace viete;
using namespace viete::mesh;

namespace {

std::vector<Point> bent(const Surface& s) {
  const double size = bounds(s.positions).diagonal();
  std::vector<Point> moved = s.positions;
  for (Point& p : moved) {
    const double angle = 0.7 * p[1] / size;
    p = {p[0] * std::cos(angle) - p[2] * std::sin(angle), p[1],
         p[0] * std::sin(angle) + p[2] * std::cos(angle)};
  }
  return moved;
}

double furthest(const std::vector<Point>& a, const std::vector<Point>& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, norm(a[v] - b[v]));
  return most;
}

// Everything except positions and normals must be equal.
void check_kept(const ReadResult& before, const ReadResult& after) {
  CHECK(after.format == before.format);
  CHECK(after.comments == before.comments);
  CHECK(after.warnings.size() == before.warnings.size());
  CHECK(after.surface.corners == before.surface.corners);
  CHECK(after.surface.polygon_starts == before.surface.polygon_starts);
  REQUIRE(bool(after.attributes) == bool(before.attributes));
  if (!before.attributes) return;
  CHECK(after.attributes->texture_points == before.attributes->texture_points);
  CHECK(after.attributes->corner_texture == before.attributes->corner_texture);
  CHECK(after.attributes->colors == before.attributes->colors);
  CHECK(after.attributes->groups.size() == before.attributes->groups.size());
  CHECK(after.attributes->materials.size() == before.attributes->materials.size());
}

void check_round_trip(const std::filesystem::path& path, const std::filesystem::path& scratch) {
  CAPTURE(path.string());
  const ReadResult read = mesh::read(path);
  REQUIRE(read.original);
  CHECK(test::written_again(read, read.surface.positions) == test::file_bytes(path));
  const auto moved = bent(read.surface);
  const auto out = scratch / path.filename();
  read.original->write_file(out, read.surface, moved, {}, nullptr);
  const ReadResult again = mesh::read(out);
  check_kept(read, again);
  CHECK(furthest(again.surface.positions, moved) <= 1e-5 * bounds(moved).diagonal());
}

void check_rest_if_it_loads(const std::filesystem::path& path) {
  CAPTURE(path.string());
  try {
    const ReadResult read = mesh::read(path);
    CHECK(test::written_again(read, read.surface.positions) == test::file_bytes(path));
  } catch (const base::Error&) {
    // Many of the files are invalid on purpose.
  }
}

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};

}  // namespace

TEST_CASE("every_shared_file_round_trips" * doctest::test_suite(test::if_present)) {
  const auto data = test::shared_data();
  if (data.empty()) return;
  const test::TemporaryFolder scratch;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string extension = extension_of(entry.path());
    const bool surface = extension == "obj" || extension == "ply" || extension == "off" || extension == "stl";
    if (!surface || !entry.is_regular_file() || entry.file_size() > 20'000'000) continue;
    const bool is_odd = entry.path().parent_path().filename() == "bad";
    is_odd ? check_rest_if_it_loads(entry.path()) : check_round_trip(entry.path(), scratch.path());
    ++files;
  }
  CHECK(files > 0);
}

TEST_CASE("openmesh_reads_a_deformed_obj_as_we_do") {
  const test::TemporaryFolder scratch;
  const Surface torus = test::torus(24, 12);
  std::string text = "o torus\n";
  const auto line = [&text](const char* word, const auto& numbers) {
    text += word;
    for (const double x : numbers) text += " " + std::to_string(x);
    text += "\n";
  };
  for (const Point& p : torus.positions) line("v", p);
  for (const Point& p : torus.positions) line("vt", Vec2{p[0] / 5, p[1] / 5});
  for (const Point& p : torus.positions) line("vn", (1 / norm(p)) * p);
  text += "s 1\n";
  for (std::size_t c = 0; c < torus.corners.size(); ++c) {
    const std::string v = std::to_string(torus.corners[c] + 1);
    text += (c % 4 == 0 ? "f " : " ") + v + "/" + v + "/" + v + (c % 4 == 3 ? "\n" : "");
  }
  test::put_file(scratch / "torus.obj", text);
  check_round_trip(scratch / "torus.obj",
                   (std::filesystem::create_directory(scratch / "out"), scratch / "out"));
  const ReadResult ours = mesh::read(scratch / "out" / "torus.obj");
  OpenMesh::PolyMesh_ArrayKernelT<DoublePoints> theirs;
  theirs.request_vertex_texcoords2D();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexTexCoord);
  REQUIRE(OpenMesh::IO::read_mesh(theirs, (scratch / "out" / "torus.obj").string(), options));
  REQUIRE(theirs.n_vertices() == ours.surface.positions.size());
  REQUIRE(theirs.n_faces() == ours.surface.polygon_count());
  CHECK(options.vertex_has_texcoord());
  for (const auto vertex : theirs.vertices()) {
    const auto v = static_cast<std::size_t>(vertex.idx());
    const auto& p = theirs.point(vertex);
    CHECK(norm(Point{p[0], p[1], p[2]} - ours.surface.positions[v]) < 1e-6);
    const auto& t = theirs.texcoord2D(vertex);
    CHECK(std::abs(t[0] - ours.attributes->texture_points[v][0]) < 1e-6);
  }
  std::size_t c = 0;
  for (const auto face : theirs.faces()) {
    for (const auto corner : theirs.fv_range(face))
      CHECK(static_cast<std::uint32_t>(corner.idx()) == ours.surface.corners[c++]);
  }
}
