#include "mesh/splats.h"

#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "deform/exact.h"
#include "files/export.h"
#include "formats/read.h"
#include "formats/write.h"
#include "library/arguments.h"

namespace viete {

struct Splats::Impl {
  std::shared_ptr<const formats::ReadResult> file;
  std::vector<mesh::Point> positions;
  std::shared_ptr<const mesh::Splats> splats;
};

Splats::Splats(const std::filesystem::path& file) {
  auto read = std::make_shared<const formats::ReadResult>(formats::read(file));
  if (!read->splats)
    throw base::Error(file.string(), "the file has no Gaussian splats",
                      "choose a .ply file with scale_0, rot_0 and opacity, or an .spz file");
  impl_ = std::make_shared<const Impl>(Impl{read, read->surface.positions, read->splats});
}

std::vector<Point3> Splats::vertices() const {
  return library::outside(impl_->positions);
}
std::span<const std::array<float, 3>> Splats::log_scales() const {
  return impl_->splats->log_scales;
}
std::span<const std::array<float, 4>> Splats::rotations() const {
  return impl_->splats->rotations;
}
std::span<const float> Splats::opacities() const {
  return impl_->splats->opacities;
}
std::span<const std::array<float, 3>> Splats::colors() const {
  return impl_->splats->colors;
}
std::span<const float> Splats::harmonics() const {
  return impl_->splats->harmonics;
}
const std::vector<std::string>& Splats::notes() const {
  return impl_->file->warnings;
}

Splats Splats::deformed(const Mesh& cage, std::span<const double> pose, const Blending& blending, int threads,
                        const Watch& watch) const {
  const base::ForkDelay delay;
  const auto bound =
      std::make_shared<const pose::Cage>(pose::make_cage(library::deformable_surface_of(cage, "the cage")));
  const pose::Pose to{
      library::deformable_points(pose, bound->surface.positions.size(), "the pose of the cage"), {}};
  const pose::Deformer deformer = library::deformer_of(blending);
  const sym3::Method method = library::method_of(blending.method);
  mesh::Surface rest;
  rest.positions = library::deformable(impl_->positions, impl_->positions.size(), "the capture");
  base::WorkerPool pool(library::checked_threads(threads));
  deform::ExactModel exact = library::watched(watch, [&](base::Progress* progress) {
    return deform::deform_exactly(rest, bound, deformer, to, method, pool, progress, nullptr, {}, nullptr,
                                  impl_->splats);
  });
  files::keep_at_rest(*bound, to, {}, rest.positions, exact.positions);
  library::check_finite(exact.positions, "positions", "use a pose closer to the rest pose");
  return Splats(std::make_shared<const Impl>(Impl{impl_->file, std::move(exact.positions), exact.splats}));
}

std::vector<std::string> Splats::write(const std::filesystem::path& file) const {
  const formats::ReadResult& read = *impl_->file;
  return formats::write(file,
                        {read.surface, impl_->positions, {}, read.attributes.get(), impl_->splats.get()},
                        read.original.get(), {});
}

}  // namespace viete
