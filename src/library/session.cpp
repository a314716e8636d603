#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/process.h"
#include "base/worker_pool.h"
#include "library/surfaces.h"
#include "scene/files/animated_model.h"
#include "scene/files/open.h"

namespace viete {

struct Session::Impl {
  explicit Impl(const std::filesystem::path& file) {
    if (!scene::is_session(file))
      throw base::Error(file.string(), "this is not a session", "choose a .viete file");
    opened = scene::open_files({scene::OpenRequest::What::model, {file}}, {});
    scene::check_deformable(opened);
    what = scene::export_of(*opened.document, {});
    const scene::Timeline& timeline = opened.document->timeline;
    if (!timeline.keys.empty())
      animated.emplace(what, timeline, scene::AnimatedModel::Precision::exact, 0, std::span<const double>{},
                       pool);
  }

  std::vector<mesh::Point> positions(double frame) {
    scene::WholePose pose{what.pose, {}, what.shape};
    deform::Probes probes = what.probes;
    if (animated) {
      pose = animated->pose(frame);
      probes = animated->probes(pose);
    }
    deform::ExactModel deformed =
        animated ? animated->exact(pose)
                 : deform::deform_exactly(*what.model, what.cage, what.scheme, pose.cage, what.method, pool,
                                          nullptr, what.mask, probes, pose.shape);
    const auto& shape = pose.shape ? *pose.shape : what.model->positions;
    scene::keep_at_rest(*what.cage, pose.cage, probes, shape, deformed.positions);
    return std::move(deformed.positions);
  }

  base::WorkerPool pool;
  scene::Opened opened;
  scene::Export what;
  std::optional<scene::AnimatedModel> animated;
};

Session::Session(const std::filesystem::path& file) : impl_(std::make_unique<Impl>(file)) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Mesh Session::model() const {
  return library::mesh_of(*impl_->what.model);
}

Mesh Session::cage() const {
  return impl_->opened.document->has_cage() ? library::mesh_of(impl_->what.cage->surface) : Mesh{};
}

std::vector<Point3> Session::pose() const {
  return impl_->opened.document->has_cage() ? library::outside(impl_->what.pose.positions)
                                            : std::vector<Point3>{};
}

std::array<int, 2> Session::range() const {
  const scene::Timeline& timeline = impl_->opened.document->timeline;
  return timeline.keys.empty() ? std::array{1, 1} : std::array{timeline.first, timeline.last};
}

const std::vector<std::string>& Session::notes() const {
  return impl_->opened.warnings;
}

std::vector<Point3> Session::frame(double frame) const {
  if (!(std::abs(frame) <= 1e6)) throw base::Error("frame", "not a valid frame", "choose a frame of range()");
  const base::ForkDelay delay;
  return library::outside(impl_->positions(frame));
}

}  // namespace viete
