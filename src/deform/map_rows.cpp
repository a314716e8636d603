#include "deform/map_rows.h"

#include <algorithm>
#include <cmath>

#include "deform/linear_map.h"
#include "sym3/exp.h"
#include "sym3/general.h"
#include "sym3/translation_log.h"

namespace viete::deform {

namespace {

using Row = std::span<double>;

// D and d of RowForm::maps.
void write_displacement(const AffineMap& map, const Vec3& rest_center, Row row) {
  for (int r = 0; r < 3; ++r) {
    double from_center = 0;
    for (int c = 0; c < 3; ++c) {
      row[3 * r + c] = map.linear[3 * r + c] - (r == c ? 1.0 : 0.0);
      from_center += row[3 * r + c] * rest_center[c];
    }
    row[map_shape.first_length + r] = (map.center[r] - rest_center[r]) - from_center;
  }
}

void write(const Vec3& v, Row row) {
  std::copy(v.begin(), v.end(), row.begin());
}

void write(const sym3::Sym3<double>& m, Row row) {
  row[0] = m.xx, row[1] = m.xy, row[2] = m.xz, row[3] = m.yy, row[4] = m.yz, row[5] = m.zz;
}

// S - I.
void write_stretch(const MapLog& log, Row row) {
  auto s = sym3::exp(log.stretch);
  s.xx -= 1, s.yy -= 1, s.zz -= 1;
  write(s, row);
}

// That of the branch: after one whole turn its negative, so that neighbours stay on one side. w - 1 = -2
// sin^2 of a quarter of the angle.
void write_quaternion(const Vec3& turn, Row row) {
  const double angle = norm(turn), quarter = std::sin(angle / 4);
  row[0] = -2 * quarter * quarter;
  write((angle > 0 ? std::sin(angle / 2) / angle : 0.5) * turn, row.subspan(1, 3));
}

// X, Y, E - I, a of RowForm::screws. a in terms of E - I: at rest it is exactly 0.
void write_screw(const MapLog& log, const Vec3& rest_center, Row row) {
  auto e = sym3::even_part(log.rotation);
  e.xx -= 1, e.yy -= 1, e.zz -= 1;
  write(log.stretch, row);
  write(log.rotation, row.subspan(6, 3));
  write(e, row.subspan(9, 6));
  const Vec3 way = log.center - rest_center;
  const Vec3 stretched{e.xx * way[0] + e.xy * way[1] + e.xz * way[2],
                       e.xy * way[0] + e.yy * way[1] + e.yz * way[2],
                       e.xz * way[0] + e.yz * way[1] + e.zz * way[2]};
  write(way + stretched - 0.5 * cross(log.rotation, log.center + rest_center), row.subspan(15, 3));
}

sym3::Mat3<double> log_of(const AffineMap& map, const MapLog& log) {
  return sym3::bounded_log(map.linear, {log.stretch, log.rotation});
}

// L, E - I, a of RowForm::affine_logs.
void write_affine_log(const AffineMap& map, const MapLog& log, const Vec3& rest_center, Row row) {
  const auto l = log_of(map, log);
  auto e = sym3::even_part(l, log.rotation);
  for (const int i : {0, 4, 8}) e[i] -= 1;
  std::copy(l.begin(), l.end(), row.begin());
  std::copy(e.begin(), e.end(), row.begin() + 9);
  const Vec3 way = log.center - rest_center;
  write(way + times(e, way) - 0.5 * times(l, log.center + rest_center), row.subspan(18, 3));
}

}  // namespace

bool has_logs(RowForm form) {
  return form != RowForm::positions && form != RowForm::maps && !has_moments(form);
}

bool has_stretch_logs(RowForm form) {
  return form == RowForm::logs || form == RowForm::screws;
}

bool has_moments(RowForm form) {
  return form == RowForm::affine_moments || form == RowForm::similar_moments ||
         form == RowForm::rigid_moments;
}

void write_row(RowForm form, const AffineMap& map, const MapLog& log, const Vec3& rest_center, Row row) {
  switch (form) {
    case RowForm::positions:
    case RowForm::affine_moments:
    case RowForm::similar_moments:
    case RowForm::rigid_moments: return;
    case RowForm::maps: return write_displacement(map, rest_center, row);
    case RowForm::logs:
      write(log.stretch, row);
      write(log.rotation, row.subspan(6, 3));
      break;
    case RowForm::stretches:
      write_stretch(log, row);
      write(log.rotation, row.subspan(6, 3));
      break;
    case RowForm::quaternions:
      write_stretch(log, row);
      write_quaternion(log.rotation, row.subspan(6, 4));
      break;
    case RowForm::screws: write_screw(log, rest_center, row); break;
    case RowForm::affine_logs: write_affine_log(map, log, rest_center, row); break;
    case RowForm::matrix_logs: {
      const auto l = log_of(map, log);
      std::copy(l.begin(), l.end(), row.begin());
      break;
    }
  }
  write(log.center, row.last(3));
}

}  // namespace viete::deform
