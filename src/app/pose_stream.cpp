#include "app/pose_stream.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "app/bound.h"
#include "base/error.h"
#include "base/worker_pool.h"
#include "deform/deformer.h"

namespace viete::app {

namespace {

constexpr double largest_number = 1e60;  // as for poses in files

// Reads the next pose; nullopt at the end of the input.
std::optional<std::vector<mesh::Point>> next_pose(std::FILE* in, std::size_t vertices, std::size_t number) {
  std::vector<mesh::Point> positions(vertices);
  static_assert(sizeof(mesh::Point) == 3 * sizeof(double));
  const std::size_t bytes = vertices * sizeof(mesh::Point), got = std::fread(positions.data(), 1, bytes, in);
  if (std::ferror(in))
    throw base::Error("standard input", std::string("cannot be read: ") + std::strerror(errno),
                      "send poses through a pipe or from a file");
  if (got == 0) return std::nullopt;
  const auto refuse = [&](const std::string& problem, const std::string& advice) {
    throw base::Error("pose " + std::to_string(number), problem, advice);
  };
  if (got < bytes)
    refuse("it ends after " + std::to_string(got) + " of " + std::to_string(bytes) + " bytes",
           "send three float64 for each vertex of the cage");
  for (std::size_t v = 0; v < vertices; ++v)
    for (const double x : positions[v])
      if (!(std::abs(x) <= largest_number))
        refuse("vertex " + std::to_string(v) + " has no finite position", "send finite numbers up to 1e60");
  return positions;
}

void write_positions(const deform::Deformer& deformer, std::size_t number, std::vector<float>& floats,
                     std::FILE* out) {
  const auto vertices = deformer.vertices();
  const mesh::Vec3 origin = deformer.origin();
  floats.clear();
  for (const auto& vertex : vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      floats.push_back(static_cast<float>(origin[k] + vertex.position[k]));
      if (!std::isfinite(floats.back()))
        throw base::Error("pose " + std::to_string(number), "a position is out of the range of float32",
                          "scale the cage and the model");
    }
  if (std::fwrite(floats.data(), sizeof(float), floats.size(), out) != floats.size() || std::fflush(out) != 0)
    throw base::Error("standard output", "it cannot be written", "check the disk space");
}

}  // namespace

void stream_poses(const scene::Export& what, std::FILE* in, std::FILE* out) {
  base::Progress progress;
  const Bound bound = app::bind(what.model, what.cage, what.scheme, what.method, {}, progress);
  base::WorkerPool pool;
  deform::Deformer deformer(bound.cage, bound.binding, what.scheme, pool, bound.stitching);
  deformer.set_mask(what.mask), deformer.set_shape(what.shape), deformer.set_probes(what.probes);
  const std::size_t vertices = what.cage->surface.positions.size();
  std::vector<float> floats;
  std::vector<mesh::Vec3> turns;
  for (std::size_t number = 1;; ++number) {
    auto positions = next_pose(in, vertices, number);
    if (!positions) return;
    deformer.deform({std::move(*positions), turns}, what.method);
    turns = deformer.state().report().turns;
    write_positions(deformer, number, floats, out);
  }
}

}  // namespace viete::app
