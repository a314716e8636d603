#include "pose/cage_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "pose/maps.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::pose {

namespace {

constexpr std::size_t log_columns = log_shape.columns;
static_assert(sizeof(MapLog) == log_columns * sizeof(double));

constexpr double cloud_radius = 0.1;  // moment_length() divided by the root mean square of the edge lengths

// Returns the length l of moments.h.
double moment_length(const Cage& cage) {
  const auto& p = cage.surface.positions;
  double sum = 0;
  for (const auto& [a, b] : cage.edges) sum += squared_norm(p[b] - p[a]);
  return cloud_radius * std::sqrt(sum / static_cast<double>(cage.edges.size()));
}

// Writes D and d of RowForm::maps to `row`. rest_center is relative to the middle of the rest cage.
void write_map_row(const AffineMap& map, const Vec3& rest_center, std::span<double> row) {
  for (int r = 0; r < 3; ++r) {
    double from_center = 0;
    for (int c = 0; c < 3; ++c) {
      row[3 * r + c] = map.linear[3 * r + c] - (r == c ? 1.0 : 0.0);
      from_center += row[3 * r + c] * rest_center[c];
    }
    row[map_shape.first_length + r] = (map.center[r] - rest_center[r]) - from_center;
  }
}

void write_log_row(const MapLog& log, std::span<double> row) {
  std::ranges::copy(numbers(log), row.begin());
  std::ranges::copy(log.center, row.begin() + log_shape.first_length);
}

// Writes rest_center / length (3 numbers), length * map.linear (9 numbers, by rows) and map.center (3
// numbers), see RowForm::affine_moments.
void write_moment_row(const AffineMap& map, const Vec3& rest_center, double length, std::span<double> row) {
  for (int i = 0; i < 3; ++i) row[i] = rest_center[i] / length;
  for (int i = 0; i < 9; ++i) row[3 + i] = length * map.linear[i];
  std::ranges::copy(map.center, row.begin() + 12);
}

MapLog scaled(const MapLog& log, const Amounts& amounts) {
  const auto& x = log.stretch;
  const double s = amounts.stretch;
  return {{s * x.xx, s * x.xy, s * x.xz, s * x.yy, s * x.yz, s * x.zz},
          amounts.rotation * log.rotation,
          log.center};
}

AffineMap map_of(const MapLog& log) {
  return {times(sym3::exp_rotation(log.rotation), full(sym3::exp(log.stretch))), log.center};
}

}  // namespace

RowForm row_form(Elements elements, Blend blend) {
  switch (blend) {
    case Blend::mls_affine: return RowForm::affine_moments;
    case Blend::mls_similarity: return RowForm::similar_moments;
    case Blend::mls_rigid: return RowForm::rigid_moments;
    case Blend::srl:
    case Blend::linear: break;
  }
  if (elements == Elements::point) return RowForm::positions;
  return blend == Blend::srl ? RowForm::logs : RowForm::maps;
}

const RowShape& shape(RowForm form) {
  if (has_moments(form)) return moment_shape;
  return form == RowForm::logs ? log_shape : form == RowForm::maps ? map_shape : position_shape;
}

std::size_t handle_count(const Cage& cage, Elements elements) {
  return handle_centers(cage, elements).size();
}

std::span<const mesh::Point> handle_centers(const Cage& cage, Elements elements) {
  if (elements == Elements::face) return cage.centers;
  return cage.surface.positions;
}

CageState::CageState(std::shared_ptr<const Cage> cage, Elements elements, RowForm form)
    : cage_(std::move(cage)), form_(form), moment_length_(moment_length(*cage_)) {
  const std::size_t handles = handle_count(*cage_, elements);
  all_ = mesh::first_numbers(handles);
  report_.turns.assign(cage_->roots.size(), {0, 0, 0});
  values_.resize(handles * shape(form_).columns);
  if (form_ == RowForm::positions) return;
  if (elements == Elements::point) patches_.emplace(*cage_, cage_->size);
  maps_.resize(handles);
  compute_maps(cage_->surface.positions, middle(cage_->surface.positions), all_);
  for (const AffineMap& map : maps_) rest_centers_.push_back(map.center);
  if (patches_) return;
  splits_.resize(handles);
  logs_.resize(handles);
}

void CageState::compute_maps(std::span<const mesh::Point> posed, const Vec3& origin,
                             std::span<const std::uint32_t> which) {
  patches_ ? patches_->compute(posed, origin, which, maps_) : face_maps(*cage_, posed, origin, which, maps_);
}

void CageState::set_amounts(const Amounts& amounts) {
  if (amounts_ == amounts) return;
  amounts_ = amounts;
  posed_ = false;
}

void CageState::keep_origin(bool keep) {
  if (std::exchange(keeps_origin_, keep) != keep) posed_ = false;
}

bool CageState::takes_logs() const {
  return form_ == RowForm::logs || (form_ == RowForm::maps && !patches_ && !amounts_.whole());
}

Rows CageState::rows() const {
  return {form_, values_, origin_, moment_length_};
}

void CageState::begin_drag(std::span<const std::uint32_t> vertices) {
  std::vector<bool> moves(cage_->surface.positions.size());
  for (const auto v : vertices) moves[v] = true;
  const auto polygon_moves = [&](std::uint32_t p) {
    return std::ranges::any_of(cage_->surface.polygon(p), [&](auto v) { return moves[v]; });
  };
  moving_.clear();
  ++resting_revision_;
  const auto moved = [&](std::uint32_t h) {
    if (maps_.empty()) return bool(moves[h]);
    if (!patches_) return polygon_moves(cage_->polygon_of(h));
    return moves[h] ||
           std::ranges::any_of(patches_->members(h), [&](const auto& m) { return moves[m.vertex]; });
  };
  std::ranges::copy_if(all_, std::back_inserter(moving_), moved);
}

void CageState::end_drag() {
  moving_.clear();
}

void CageState::set_pose(const Pose& pose) {
  check_pose(*cage_, pose.positions.size());
  times_ = {};
  const bool few = posed_ && !moving_.empty();
  const auto& rest = cage_->surface.positions;
  if (!few) origin_ = keeps_origin_ ? middle(rest) : pose_origin(*cage_, pose.positions);
  if (!maps_.empty() ? set_maps(pose, few) : set_positions(pose, few)) ++resting_revision_;
  posed_ = true;
}

bool CageState::set_positions(const Pose& pose, bool few) {
  report_ = {pose.turns, {}, {}};
  for (const auto h : few ? moving_ : all_) {
    const Vec3 p = pose.positions[h] - origin_;
    std::copy(p.begin(), p.end(), values_.begin() + 3 * h);
  }
  return !few;
}

bool CageState::set_maps(const Pose& pose, bool few) {
  base::Stopwatch watch;
  const std::span<const std::uint32_t> moved = few ? moving_ : all_;
  compute_maps(pose.positions, origin_, moved);
  times_[Stage::maps] = watch.lap_ms();
  if (!takes_logs()) {
    report_ = {pose.turns, {}, {}};
    for (const auto h : moved) write_row_of(h);
    return !few;
  }
  if (few) logs_before_ = logs_;
  split_maps(maps_, moved, splits_);
  log_maps(*cage_, maps_, splits_, pose.turns, logs_, report_);
  const bool others_moved = !few || !others_stayed();
  for (const auto h : others_moved ? std::span<const std::uint32_t>(all_) : moved) write_row_of(h);
  times_[Stage::log_maps] = watch.lap_ms();
  return others_moved;
}

void CageState::write_row_of(std::uint32_t h) {
  const std::size_t columns = shape(form_).columns;
  const auto row = std::span(values_).subspan(h * columns, columns);
  if (has_moments(form_)) return write_moment_row(maps_[h], rest_centers_[h], moment_length_, row);
  if (!takes_logs()) return write_map_row(maps_[h], rest_centers_[h], row);
  const MapLog log = amounts_.whole() ? logs_[h] : scaled(logs_[h], amounts_);
  form_ == RowForm::logs ? write_log_row(log, row) : write_map_row(map_of(log), rest_centers_[h], row);
}

// Returns true if the logs outside moving_ did not change, compared as floats. (The branch of a log can
// change with its neighbours' logs.)
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

}  // namespace viete::pose
