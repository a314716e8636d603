#include "sym3/affine.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sym3/general.h"
#include "sym3/products.h"
#include "sym3/solve.h"
#include "sym3/translation_log.h"

namespace viete::sym3 {

namespace {

// A^-1 B.
Affine from(const Affine& a, const Affine& b) {
  std::array<std::array<double, 4>, 3> rows;
  for (std::size_t r = 0; r < 3; ++r) {
    rows[r] = {b.linear[3 * r], b.linear[3 * r + 1], b.linear[3 * r + 2],
               b.translation[r] - a.translation[r]};
  }
  const auto x = solved<4>(a.linear, rows);
  Affine map;
  for (std::size_t r = 0; r < 3; ++r) {
    std::copy_n(x[r].begin(), 3, map.linear.begin() + 3 * r);
    map.translation[r] = x[r][3];
  }
  return map;
}

AffineLog added(const AffineLog& a, double s, const AffineLog& b) {
  return {plus(a.linear, s, b.linear), plus(a.translation, s, b.translation)};
}

}  // namespace

Affine operator*(const Affine& a, const Affine& b) {
  return {product(a.linear, b.linear), plus(product(a.linear, b.translation), 1, a.translation)};
}

Affine inverse(const Affine& a) {
  return from(a, {});
}

AffineLog log_affine(const Affine& map) {
  const Mat3<double> l = log_general(map.linear);
  return {l, inverse_phi_times(l, {}, map.translation)};
}

AffineLog log_affine(const Affine& map, const Vec3<double>& near) {
  const Mat3<double> l = log_near(map.linear, near);
  return {l, inverse_phi_times(l, turn_of({l, {}}), map.translation)};
}

Affine exp_affine(const AffineLog& log) {
  return {exp_general(log.linear), phi_times(log.linear, log.translation)};
}

Vec3<double> turn_of(const AffineLog& log) {
  const Mat3<double>& l = log.linear;
  return {(l[7] - l[5]) / 2, (l[2] - l[6]) / 2, (l[3] - l[1]) / 2};
}

AffineLog weighted_sum(std::span<const AffineLog> logs, std::span<const double> weights) {
  AffineLog sum;
  for (std::size_t i = 0; i < logs.size(); ++i) sum = added(sum, weights[i], logs[i]);
  return sum;
}

namespace {

// sum w log(origin^-1 A).
AffineLog sum_of_logs(const Affine& origin, std::span<const Affine> maps, std::span<const double> weights) {
  AffineLog sum;
  for (std::size_t i = 0; i < maps.size(); ++i)
    sum = added(sum, weights[i], log_affine(from(origin, maps[i])));
  return sum;
}

}  // namespace

Affine combine(std::span<const Affine> maps, std::span<const double> weights) {
  return exp_affine(sum_of_logs({}, maps, weights));
}

Affine interpolate(const Affine& a, const Affine& b, double t) {
  return a * exp_affine(added({}, t, log_affine(from(a, b))));
}

Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near) {
  return a * exp_affine(added({}, t, log_affine(from(a, b), near)));
}

AffineMean mean(std::span<const Affine> maps, std::span<const double> weights) {
  constexpr int most_steps = 200;
  constexpr double near_the_end = 1e-6;  // from there on what is left falls until it is rounding
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  AffineMean m{maps[heaviest], false, 0};
  double turned = HUGE_VAL, moved = HUGE_VAL;
  bool turned_enough = false, moved_enough = false;
  for (; !m.converged && m.steps < most_steps; ++m.steps) {
    const AffineLog step = added({}, 1 / total, sum_of_logs(m.map, maps, weights));
    const double turns = norm(step.linear), moves = norm(step.translation);
    if (!std::isfinite(turns + moves)) break;
    const bool near = turns < near_the_end;
    turned_enough = turned_enough || (near && turns >= turned);
    moved_enough = moved_enough || (near && moves >= moved);
    m.converged = turned_enough && moved_enough;
    m.map = m.map * exp_affine(step);
    turned = turns, moved = moves;
  }
  return m;
}

}  // namespace viete::sym3
