#include "deform/cage_state.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/map_rows.h"

namespace viete::deform {

namespace {

constexpr std::size_t log_columns = log_shape.columns;
static_assert(sizeof(MapLog) == log_columns * sizeof(double));

}  // namespace

void check_pose(const Cage& cage, const Pose& pose) {
  const std::size_t expected = cage.surface.positions.size();
  if (pose.positions.size() == expected) return;
  throw base::Error("",
                    "the pose has " + std::to_string(pose.positions.size()) + " vertices, the cage " +
                        std::to_string(expected),
                    "use a pose of this cage");
}

RowForm row_form(Elements elements, Blend blend) {
  if (!entry(elements).affine) return RowForm::positions;
  switch (blend) {
    case Blend::srl: return RowForm::logs;
    case Blend::linear: return RowForm::maps;
    case Blend::slrl: return RowForm::stretches;
    case Blend::sql: return RowForm::quaternions;
    case Blend::log3: return RowForm::matrix_logs;
  }
  return RowForm::maps;
}

const RowShape& shape(RowForm form) {
  switch (form) {
    case RowForm::logs: return log_shape;
    case RowForm::maps: return map_shape;
    case RowForm::positions: return position_shape;
    case RowForm::stretches: return stretch_shape;
    case RowForm::quaternions: return quaternion_shape;
    case RowForm::matrix_logs: break;
  }
  return matrix_log_shape;
}

std::size_t handle_count(const Cage& cage, Elements elements) {
  return handle_centers(cage, elements).size();
}

std::span<const mesh::Point> handle_centers(const Cage& cage, Elements elements) {
  return entry(elements).handles == Handles::faces ? cage.centers : cage.surface.positions;
}

CageState::CageState(std::shared_ptr<const Cage> cage, Elements elements, Blend blend)
    : cage_(std::move(cage)), elements_(elements), form_(row_form(elements, blend)) {
  const std::size_t handles = handle_count(*cage_, elements);
  all_.resize(handles);
  std::iota(all_.begin(), all_.end(), 0u);
  report_.turns.assign(cage_->roots.size(), {0, 0, 0});
  if (form_ != RowForm::logs) values_.resize(handles * shape(form_).columns);
  if (form_ == RowForm::positions) return;
  maps_.resize(handles);
  if (elements == Elements::patch) patches_ = make_patches(*cage_);
  if (!has_logs(form_)) return;
  splits_.resize(handles);
  logs_.resize(handles);
}

Rows CageState::rows() const {
  if (form_ != RowForm::logs) return {form_, values_, origin_};
  return {form_, {reinterpret_cast<const double*>(logs_.data()), log_columns * logs_.size()}, origin_};
}

void CageState::begin_drag(std::span<const std::uint32_t> vertices) {
  std::vector<bool> moves(cage_->surface.positions.size());
  for (const auto v : vertices) moves[v] = true;
  moving_.clear();
  ++resting_revision_;
  for (const auto h : all_) {
    if (moves_with(h, moves)) moving_.push_back(h);
  }
}

bool CageState::moves_with(std::uint32_t handle, const std::vector<bool>& vertices) const {
  switch (elements_) {
    case Elements::point: return vertices[handle];
    case Elements::face:
      return std::ranges::any_of(cage_->surface.triangles[handle], [&](auto v) { return vertices[v]; });
    case Elements::patch:
      return std::ranges::any_of(patches_.of(handle), [&](const auto& p) { return vertices[p.vertex]; });
  }
  return false;
}

void CageState::end_drag() {
  moving_.clear();
}

void CageState::set_pose(const Pose& pose) {
  check_pose(*cage_, pose);
  times_ = {};
  base::Stopwatch watch;
  const bool few = posed_ && !moving_.empty();
  if (!few) origin_ = pose_origin(*cage_, pose.positions);
  const std::span<const std::uint32_t> moved = few ? moving_ : all_;
  if (form_ != RowForm::positions) {
    if (elements_ == Elements::patch) {
      patch_maps(*cage_, patches_, pose.positions, origin_, moved, maps_);
    } else {
      face_maps(*cage_, pose.positions, origin_, moved, maps_);
    }
    times_[Link::maps] = watch.lap_ms();
  }
  bool others_moved = !few;
  if (has_logs(form_)) {
    if (few) logs_before_ = logs_;
    split_maps(maps_, moved, splits_);
    log_maps(*cage_, maps_, splits_, pose.turns, logs_, report_);
    others_moved = !few || !others_stayed();
  } else {
    report_ = {pose.turns, {}, {}};
  }
  if (form_ != RowForm::logs) write_values(pose, others_moved ? std::span<const std::uint32_t>(all_) : moved);
  if (has_logs(form_)) times_[Link::log_maps] = watch.lap_ms();
  if (others_moved) ++resting_revision_;
  posed_ = true;
}

void CageState::write_values(const Pose& pose, std::span<const std::uint32_t> handles) {
  const Vec3 rest_origin = middle(cage_->surface.positions);
  const std::size_t columns = shape(form_).columns;
  for (const auto h : handles) {
    const auto row = std::span(values_).subspan(h * columns, columns);
    if (form_ == RowForm::positions) {
      const Vec3 p = pose.positions[h] - origin_;
      std::copy(p.begin(), p.end(), row.begin());
    } else {
      const Vec3 center = element_center(*cage_, h, cage_->surface.positions, rest_origin);
      write_row(form_, maps_[h], has_logs(form_) ? logs_[h] : MapLog{}, center, row);
    }
  }
}

// An element that no vertex of moved can still take another branch of its log. What floats do not tell apart
// is the same: an axis may follow that of its neighbour in its last bits.
bool CageState::others_stayed() const {
  const auto* now = reinterpret_cast<const double*>(logs_.data());
  const auto* before = reinterpret_cast<const double*>(logs_before_.data());
  auto moving = moving_.begin();
  for (std::size_t h = 0; h < logs_.size(); ++h) {
    if (moving != moving_.end() && *moving == h) {
      ++moving;
      continue;
    }
    for (std::size_t i = h * log_columns; i < (h + 1) * log_columns; ++i) {
      if (static_cast<float>(now[i]) != static_cast<float>(before[i])) return false;
    }
  }
  return true;
}

}  // namespace viete::deform
