#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "files/animated_model.h"
#include "files/open.h"
#include "library/arguments.h"

namespace viete {

struct Session::Impl {
  explicit Impl(const std::filesystem::path& file) {
    if (!files::is_session(file))
      throw base::Error(file.string(), "this file is not a session", "choose a .viete file");
    opened = files::open_files({files::OpenRequest::What::model, {file}}, {});
    files::check_deformable(opened);
    what = files::export_of(*opened.document, {});
    const document::Timeline& timeline = opened.document->timeline();
    if (timeline.has_poses())
      animated.emplace(what, timeline, files::AnimatedModel::Precision::exact, 0, std::span<const double>{},
                       pool);
  }

  std::vector<mesh::Point> positions(double frame) {
    document::WholePose pose{what.pose, {}, what.shape};
    pose::Probes probes = what.probes;
    if (animated) {
      pose = animated->pose(frame);
      probes = animated->probes(pose);
    }
    deform::ExactModel deformed =
        animated ? animated->exact(pose)
                 : deform::deform_exactly(*what.model, what.cage, what.deformer, pose.cage, what.method, pool,
                                          nullptr, what.mask, probes, pose.shape, what.splats);
    const auto& shape = pose.shape ? *pose.shape : what.model->positions;
    files::keep_at_rest(*what.cage, pose.cage, probes, shape, deformed.positions);
    return std::move(deformed.positions);
  }

  base::WorkerPool pool;
  files::Opened opened;
  files::Export what;
  std::optional<files::AnimatedModel> animated;
};

Session::Session(const std::filesystem::path& file) : impl_(library::hidden<Impl>(file)) {}

Mesh Session::model() const {
  return library::mesh_of(*impl_->what.model);
}

std::array<int, 2> Session::range() const {
  const document::Timeline& timeline = impl_->opened.document->timeline();
  return timeline.has_poses() ? std::array{timeline.first, timeline.last} : std::array{1, 1};
}

const std::vector<std::string>& Session::notes() const {
  return impl_->opened.warnings;
}

std::vector<Point3> Session::frame(double frame) const {
  if (!(std::abs(frame) <= 1e6))
    throw base::Error("frame", "it is out of range", "choose a frame of range()");
  const base::ForkDelay delay;
  return library::outside(impl_->positions(frame));
}

}  // namespace viete
