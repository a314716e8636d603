#include "deform/cage_state.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/all_element_maps.h"
#include "deform/face_maps.h"
#include "deform/linear_map.h"
#include "deform/map_rows.h"
#include "deform/moment_rows.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::deform {

namespace {

constexpr std::size_t log_columns = log_shape.columns;
static_assert(sizeof(MapLog) == log_columns * sizeof(double));

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

// Of elements with several maps.
LogReport of_handles(LogReport report, const std::vector<std::uint32_t>& owners) {
  for (auto& m : report.collapsed) m = owners[m];
  const auto again = std::unique(report.collapsed.begin(), report.collapsed.end());
  report.collapsed.erase(again, report.collapsed.end());
  for (auto& [a, b] : report.torn) a = owners[a], b = owners[b];
  std::sort(report.torn.begin(), report.torn.end());
  report.torn.erase(std::unique(report.torn.begin(), report.torn.end()), report.torn.end());
  return report;
}

MapLog scaled(const MapLog& log, const Amounts& amounts) {
  const auto& x = log.stretch;
  const double s = amounts.stretch;
  return {
      {s * x.xx, s * x.xy, s * x.xz, s * x.yy, s * x.yz, s * x.zz}, amounts.turn * log.rotation, log.center};
}

AffineMap map_of(const MapLog& log) {
  return {times(sym3::exp_rotation(log.rotation), full(sym3::exp(log.stretch))), log.center};
}

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
  if (!entry(elements).affine && !entry(blend).of_points) return RowForm::positions;
  switch (blend) {
    case Blend::srl: return RowForm::logs;
    case Blend::linear: return RowForm::maps;
    case Blend::slrl: return RowForm::stretches;
    case Blend::sql: return RowForm::quaternions;
    case Blend::log3: return RowForm::matrix_logs;
    case Blend::sse: return RowForm::screws;
    case Blend::log4: return RowForm::affine_logs;
    case Blend::mls_affine: return RowForm::affine_moments;
    case Blend::mls_similarity: return RowForm::similar_moments;
    case Blend::mls_rigid: return RowForm::rigid_moments;
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
    case RowForm::matrix_logs: return matrix_log_shape;
    case RowForm::screws: return screw_shape;
    case RowForm::affine_logs: return affine_log_shape;
    case RowForm::affine_moments:
    case RowForm::similar_moments:
    case RowForm::rigid_moments: break;
  }
  return moment_shape;
}

std::size_t handle_count(const Cage& cage, Elements elements) {
  return handle_centers(cage, elements).size();
}

std::span<const mesh::Point> handle_centers(const Cage& cage, Elements elements) {
  switch (entry(elements).handles) {
    case Handles::faces: return cage.centers;
    case Handles::polygon_faces: return cage.polygon_centers;
    case Handles::edges: return cage.edge_centers;
    case Handles::vertices: break;
  }
  return cage.surface.positions;
}

CageState::CageState(std::shared_ptr<const Cage> cage, Elements elements, Blend blend, bool as_before)
    : cage_(std::move(cage)),
      handles_(entry(elements).handles),
      form_(row_form(elements, blend)),
      moment_length_(deform::moment_length(*cage_)) {
  const std::size_t handles = handle_count(*cage_, elements);
  all_ = first_numbers(handles);
  report_.turns.assign(cage_->roots.size(), {0, 0, 0});
  values_.resize(handles * shape(form_).columns);
  if (form_ == RowForm::positions) return;
  elements_ = element_maps(*cage_, has_moments(form_) ? Elements::vertex_patch : elements, as_before);
  all_maps_ = first_numbers(elements_->count());
  maps_.resize(elements_->count());
  rest_centers_.resize(handles);
  elements_->compute(cage_->surface.positions, middle(cage_->surface.positions), all_maps_, maps_);
  for (const auto m : all_maps_) rest_centers_[elements_->owners()[m]] = maps_[m].center;
  splits_.resize(elements_->count());
  logs_.resize(elements_->count());
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
  return has_logs(form_) || (elements_ && !has_moments(form_) && !amounts_.whole());
}

Rows CageState::rows() const {
  return {form_, values_, origin_, moment_length_};
}

void CageState::begin_drag(std::span<const std::uint32_t> vertices) {
  std::vector<bool> moves(cage_->surface.positions.size());
  for (const auto v : vertices) moves[v] = true;
  moving_.clear(), moving_maps_.clear();
  ++resting_revision_;
  std::vector<bool> moved = moves;  // handles
  if (elements_) {
    moved.assign(all_.size(), false);
    for (const auto m : all_maps_) {
      if (std::ranges::any_of(elements_->vertices(m), [&](auto v) { return moves[v]; }))
        moved[elements_->owners()[m]] = true;
    }
  }
  std::ranges::copy_if(all_, std::back_inserter(moving_), [&](auto h) { return moved[h]; });
  std::ranges::copy_if(all_maps_, std::back_inserter(moving_maps_),
                       [&](auto m) { return moved[elements_->owners()[m]]; });
}

void CageState::end_drag() {
  moving_.clear(), moving_maps_.clear();
}

void CageState::set_pose(const Pose& pose) {
  check_pose(*cage_, pose);
  times_ = {};
  const bool few = posed_ && !moving_.empty();
  const auto& rest = cage_->surface.positions;
  if (!few) origin_ = keeps_origin_ ? middle(rest) : pose_origin(*cage_, pose.positions);
  if (elements_ ? set_maps(pose, few) : set_positions(pose, few)) ++resting_revision_;
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
  const std::span<const std::uint32_t> moved = few ? moving_maps_ : all_maps_;
  elements_->compute(pose.positions, origin_, moved, maps_);
  times_[Link::maps] = watch.lap_ms();
  if (!takes_logs()) {
    report_ = {pose.turns, {}, {}};
    write_rows(moved);
    return !few;
  }
  if (few) logs_before_ = logs_;
  split_maps(maps_, moved, splits_);
  log_maps(elements_->graph(), maps_, splits_, pose.turns, logs_, report_);
  const bool others_moved = !few || !others_stayed();
  write_rows(others_moved ? std::span<const std::uint32_t>(all_maps_) : moved);
  if (!elements_->single()) report_ = of_handles(std::move(report_), elements_->owners());
  report_.handles = handles_;
  times_[Link::log_maps] = watch.lap_ms();
  return others_moved;
}

// All maps of an element are among them, or none.
void CageState::write_rows(std::span<const std::uint32_t> maps) {
  const std::size_t columns = shape(form_).columns;
  double own[most_columns];
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const auto m = maps[n], handle = elements_->owners()[m];
    const auto row = std::span(values_).subspan(handle * columns, columns);
    if (elements_->single()) {
      write_row_of(m, row);
      continue;
    }
    write_row_of(m, std::span(own, columns));
    const bool first = n == 0 || elements_->owners()[maps[n - 1]] != handle;
    const double share = elements_->shares()[m];
    for (std::size_t c = 0; c < columns; ++c) row[c] = (first ? 0 : row[c]) + share * own[c];
  }
}

void CageState::write_row_of(std::uint32_t m, std::span<double> row) const {
  const Vec3& rest_center = rest_centers_[elements_->owners()[m]];
  if (has_moments(form_)) return write_moment_row(maps_[m], rest_center, moment_length_, row);
  if (!takes_logs()) return write_row(form_, maps_[m], {}, rest_center, row);
  if (amounts_.whole()) return write_row(form_, maps_[m], logs_[m], rest_center, row);
  const MapLog log = scaled(logs_[m], amounts_);
  write_row(form_, map_of(log), log, rest_center, row);
}

// A map that no vertex of moved can still take another branch of its log. What floats do not tell apart
// is the same: an axis may follow that of its neighbour in its last bits.
bool CageState::others_stayed() const {
  const auto* now = reinterpret_cast<const double*>(logs_.data());
  const auto* before = reinterpret_cast<const double*>(logs_before_.data());
  auto moving = moving_maps_.begin();
  for (std::size_t h = 0; h < logs_.size(); ++h) {
    if (moving != moving_maps_.end() && *moving == h) {
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
