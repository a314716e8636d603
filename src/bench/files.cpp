#include "bench/files.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/quantity.h"
#include "bench/bars.h"
#include "bench/table.h"
#include "bench/timing/rounds.h"
#include "mesh/formats/read.h"

namespace viete::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t grid_cells = 708;  // twice as many triangles as cells: 1,002,528

// A wavy sheet as programs export it: v and vt with 6 decimals, vn with 4.
std::string wavy_sheet() {
  std::string v, vt, vn, f;
  char line[128];
  const auto add = [&line](std::string& to, const char* format, auto... values) {
    to.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, format, values...)));
  };
  for (std::size_t i = 0; i <= grid_cells; ++i) {
    for (std::size_t j = 0; j <= grid_cells; ++j) {
      const double s = double(i) / double(grid_cells), t = double(j) / double(grid_cells), x = 10 * s,
                   y = 10 * t;
      const double dx = -std::cos(x) * std::cos(y), dy = std::sin(x) * std::sin(y),
                   length = std::hypot(dx, dy, 1);
      add(v, "v %.6f %.6f %.6f\n", x, y, std::sin(x) * std::cos(y));
      add(vt, "vt %.6f %.6f\n", s, t);
      add(vn, "vn %.4f %.4f %.4f\n", dx / length, dy / length, 1 / length);
      if (i == grid_cells || j == grid_cells) continue;
      const std::size_t a = i * (grid_cells + 1) + j + 1, b = a + grid_cells + 1, c = b + 1, d = a + 1;
      add(f, "f %zu/%zu/%zu %zu/%zu/%zu %zu/%zu/%zu\n", a, a, a, b, b, b, c, c, c);
      add(f, "f %zu/%zu/%zu %zu/%zu/%zu %zu/%zu/%zu\n", a, a, a, c, c, c, d, d, d);
    }
  }
  return "o sheet\n" + v + vt + vn + "s 1\n" + f;
}

// The model that was named, or one that is made and goes again.
class BenchModel {
public:
  explicit BenchModel(const fs::path& named) : path_(named), made_(named.empty()) {
    if (!made_) return;
    path_ = base::unused_name(fs::temp_directory_path() / "viete-bench.obj");
    base::replace_file(path_, wavy_sheet(), base::Durability::process);
  }
  ~BenchModel() {
    std::error_code ignored;
    if (made_) fs::remove(path_, ignored);
  }
  BenchModel(const BenchModel&) = delete;
  BenchModel& operator=(const BenchModel&) = delete;

  const fs::path& path() const { return path_; }
  bool made() const { return made_; }

private:
  fs::path path_;
  bool made_;
};

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

// False if OpenMesh cannot.
bool read_by_openmesh(const fs::path& path) {
  OpenMesh::PolyMesh_ArrayKernelT<DoublePoints> mesh;
  mesh.request_vertex_normals();
  mesh.request_halfedge_texcoords2D();
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::FaceTexCoord);
  omerr().disable();
  const bool read = OpenMesh::IO::read_mesh(mesh, path.string(), options) && mesh.n_vertices() > 0;
  omerr().enable();
  return read;
}

std::vector<mesh::Point> bent(std::vector<mesh::Point> positions) {
  const double size = mesh::bounds(positions).diagonal();
  for (mesh::Point& p : positions) {
    const double angle = size > 0 ? 0.5 * p[0] / size : 0;
    p = {p[0], p[1] * std::cos(angle) - p[2] * std::sin(angle),
         p[1] * std::sin(angle) + p[2] * std::cos(angle)};
  }
  return positions;
}

std::size_t write_again(const mesh::ReadResult& read, const std::vector<mesh::Point>& positions) {
  std::size_t bytes = 0;
  mesh::TextWriter out([&bytes](std::string_view portion) { bytes += portion.size(); });
  read.original->write(read.surface, positions, out);
  out.finish();
  return bytes;
}

}  // namespace

void bench_files(const FilesOptions& options) {
  const BenchModel model(options.model);
  const mesh::ReadResult read = mesh::read(model.path());
  const auto moved = bent(read.surface.positions);
  const auto bytes = static_cast<std::size_t>(fs::file_size(model.path()));
  std::vector<RoundCase> cases = {
      {"plain read of the bytes", bytes, [&](std::size_t) { mesh::FileBytes(model.path(), nullptr); }},
      {"read", bytes, [&](std::size_t) { mesh::read(model.path()); }}};
  if (read_by_openmesh(model.path()))
    cases.push_back({"read by OpenMesh", bytes, [&](std::size_t) { read_by_openmesh(model.path()); }});
  if (read.original) {
    cases.push_back({"written again at rest", write_again(read, read.surface.positions),
                     [&](std::size_t) { write_again(read, read.surface.positions); }});
    cases.push_back({"written again, deformed", write_again(read, moved),
                     [&](std::size_t) { write_again(read, moved); }});
  }
  base::Progress progress;
  const auto results = measure_rounds(cases, options.rounds, progress);
  std::printf("files: %s, %s of %s triangles; one thread, its processor time, medians of interleaved runs\n",
              read.format.c_str(), base::memory_size(double(bytes)).c_str(),
              base::with_thousands(read.surface.triangles.size()).c_str());
  const auto speed = [](const BenchResult& r) { return r.ns_per_item > 0 ? 1e3 / r.ns_per_item : 0; };
  for (const BenchResult& r : results) std::printf("  %-30s %8.0f MB/s\n", r.name.c_str(), speed(r));
  Bars bars;
  if (model.made()) {
    bars.check("read, MB/s", 1e3 / time_of(results, "read"), 200, true);
    bars.check("written again, deformed, MB/s", 1e3 / time_of(results, "written again, deformed"), 150, true);
  }
  write_json(options.json, {{"figure", "files"}, {"results", to_json(results)}, {"bars", bars.rows}});
}

}  // namespace viete::bench
