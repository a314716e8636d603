#include "sym3/route.h"

#include <cmath>

#include "sym3/exp_paper.h"
#include "sym3/exp_tables.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

namespace {

Route route_of_fast(const Sym3<double>& s) {
  using C = ExpTables<double>;
  Route route{.degree = static_cast<int>(sizeof(C::matrix_exp) / sizeof(double)) - 1};
  const double trace = s.xx + s.yy + s.zz, mean = trace / 3;
  const double x = s.xx - mean, y = s.yy - mean, z = s.zz - mean;
  double p = (x * x + y * y + z * z) / 2 + s.xy * s.xy + s.xz * s.xz + s.yz * s.yz;
  if (p <= C::p_limit && std::abs(trace) <= C::trace_limit) return route;
  for (; p > C::p_limit && route.squarings < C::max_squarings; p /= 4) ++route.squarings;
  if (is_diagonal(s) || !(p <= C::p_limit) || !is_finite(exp(s, Method::fast))) return {.by_jacobi = true};
  return route;
}

}  // namespace

Route route(const Sym3<double>& s, Method method) {
  if (method == Method::fast) return route_of_fast(s);
  if (method == Method::diag || !is_finite(s)) return {};
  if (method == Method::sd) return {.distinct = distinct_by_qr(s)};
  return {.distinct = distinct_by_viete(s, method == Method::improved_sd_faithful)};
}

}  // namespace viete::sym3
