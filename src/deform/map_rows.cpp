#include "deform/map_rows.h"

#include <algorithm>
#include <cmath>

#include "deform/matrix_log.h"
#include "sym3/exp.h"

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

}  // namespace

bool has_logs(RowForm form) {
  return form != RowForm::positions && form != RowForm::maps;
}

bool has_stretch_logs(RowForm form) {
  return form == RowForm::logs;
}

void write_row(RowForm form, const AffineMap& map, const MapLog& log, const Vec3& rest_center, Row row) {
  switch (form) {
    case RowForm::positions: return;
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
    case RowForm::matrix_logs: {
      const auto l = matrix_log(map.linear, log);
      std::copy(l.begin(), l.end(), row.begin());
      break;
    }
  }
  write(log.center, row.last(3));
}

}  // namespace viete::deform
