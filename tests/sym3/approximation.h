// Approximates functions by polynomials in 113 bits: by Chebyshev points, or minimax by Remez' algorithm.
#pragma once

#include <quadmath.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace viete::test {

using Quad = __float128;
using QuadFunction = std::function<Quad(Quad)>;
using Polynomial = std::vector<Quad>;  ///< the coefficients of 1, x, x^2 ...

inline Quad at(const Polynomial& p, Quad x) {
  Quad sum = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) sum = sum * x + *c;
  return sum;
}

/// Returns the polynomial with `count` coefficients that equals f at the Chebyshev points of [0, end].
/// Computes a Chebyshev series first, to avoid cancellation.
inline Polynomial interpolated(const QuadFunction& f, Quad end, int count) {
  const auto angle = [=](int j) { return M_PIq * (2 * j + 1) / (2 * count); };
  std::vector<Quad> values;
  for (int j = 0; j < count; ++j) values.push_back(f(end * (1 + cosq(angle(j))) / 2));
  Polynomial sum(count, 0), before(count, 0),
      last(count, 0);  // the two previous shifted Chebyshev polynomials of y = x / end
  for (int k = 0; k < count; ++k) {
    Polynomial next(count, 0);  // 1, then 2 y - 1, then (4 y - 2) * last - before
    const int factor = k == 1 ? 1 : 2;
    for (int i = 0; i < count && k > 0; ++i)
      next[i] = factor * ((i > 0 ? 2 * last[i - 1] : 0) - last[i]) - before[i];
    if (k == 0) next[0] = 1;
    Quad series = 0;
    for (int j = 0; j < count; ++j) series += values[j] * cosq(k * angle(j));
    for (int i = 0; i < count; ++i) sum[i] += series * (k == 0 ? 1 : 2) / count * next[i];
    before = k == 0 ? before : last;
    last = next;
  }
  Quad power = 1;
  for (Quad& c : sum) {
    c /= power;
    power *= end;
  }
  return sum;
}

/// Values of a function at points of [low, high], and weights of errors. Points are denser at the ends.
struct Target {
  std::vector<Quad> points, values, weights;

  Target(const QuadFunction& f, const QuadFunction& weight, Quad low, Quad high, int count = 800) {
    for (int i = 0; i < count; ++i) {
      points.push_back((low + high) / 2 - (high - low) / 2 * cosq(M_PIq * (i + Quad(0.5)) / count));
      values.push_back(f(points.back()));
      weights.push_back(weight(points.back()));
    }
  }

  std::vector<Quad> errors(const Polynomial& p) const {
    std::vector<Quad> all;
    for (std::size_t i = 0; i < points.size(); ++i)
      all.push_back(weights[i] * (values[i] - at(p, points[i])));
    return all;
  }
};

inline Quad largest(const std::vector<Quad>& errors) {
  Quad most = 0;
  for (const Quad e : errors) most = std::max(most, fabsq(e));
  return most;
}

/// Solves a linear system. The last number of each row is the right-hand side.
inline std::vector<Quad> solved(std::vector<std::vector<Quad>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k + 1; i < n; ++i)
      if (fabsq(rows[i][k]) > fabsq(rows[k][k])) std::swap(rows[i], rows[k]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Quad factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::vector<Quad> x(n);
  for (std::size_t k = n; k-- > 0;) {
    x[k] = rows[k][n];
    for (std::size_t j = k + 1; j < n; ++j) x[k] -= rows[k][j] * x[j];
    x[k] /= rows[k][k];
  }
  return x;
}

/// Returns for each run of equal signs the position of the largest absolute value. At most `count` positions.
inline std::vector<std::size_t> alternating(const std::vector<Quad>& values, std::size_t count) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (found.empty() || (values[found.back()] > 0) != (values[i] > 0)) {
      found.push_back(i);
    } else if (fabsq(values[i]) > fabsq(values[found.back()])) {
      found.back() = i;
    }
  }
  while (found.size() > count)
    found.erase(fabsq(values[found.front()]) < fabsq(values[found.back()]) ? found.begin() : found.end() - 1);
  return found;
}

/// Returns `p` with new coefficients from x^first on, which make the largest error smallest (Remez). If
/// errors with alternating signs are not possible, returns the best polynomial found.
inline Polynomial minimax(const Target& t, Polynomial p, int first) {
  const int count = static_cast<int>(p.size()), unknown = count - first;
  const Polynomial kept(p.begin(), p.begin() + first);
  // All replaced terms have the factor x^first. If `first` is odd, the factor changes its sign at 0.
  const auto sign = [&](std::size_t i) { return first % 2 && t.points[i] < 0 ? -1 : 1; };
  const auto extremes_of = [&](std::vector<Quad> errors) {
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] *= sign(i);
    return alternating(errors, static_cast<std::size_t>(unknown) + 1);
  };
  Polynomial best = p;
  Quad best_error = largest(t.errors(p));
  auto extremes = extremes_of(t.errors(p));
  if (extremes.size() <=
      static_cast<std::size_t>(unknown)) {  // too few extremes: starts with equally spaced points
    extremes.clear();
    for (int i = 0; i <= unknown; ++i) extremes.push_back((2 * i + 1) * t.points.size() / (2 * unknown + 2));
  }
  for (int step = 0; step < 40; ++step) {
    std::vector<std::vector<Quad>> rows;
    for (std::size_t n = 0; n < extremes.size(); ++n) {
      const std::size_t i = extremes[n];
      std::vector<Quad> row;
      Quad power = 1;
      for (int k = 0; k < count; ++k, power *= t.points[i])
        if (k >= first) row.push_back(power);
      row.push_back((n % 2 ? -1 : 1) / t.weights[i] * sign(i));
      row.push_back(t.values[i] - at(kept, t.points[i]));
      rows.push_back(row);
    }
    const auto solution = solved(rows);
    std::copy(solution.begin(), solution.end() - 1, p.begin() + first);
    const auto errors = t.errors(p);
    if (largest(errors) < best_error) {
      best = p;
      best_error = largest(errors);
    }
    const auto next = extremes_of(errors);
    if (next.size() < extremes.size() || next == extremes) break;
    extremes = next;
  }
  return best;
}

template <class T>
Quad rounded(Quad x, Quad unit) {
  return static_cast<T>(x / unit) * unit;
}

/// Returns the minimax polynomial with the first coefficients `kept`. All other coefficients are rounded to
/// x * unit, where x has the type T. Coefficients before index `one_by_one` are rounded one by one; after
/// each rounding, later coefficients are fitted again. Coefficients from this index on are rounded together.
template <class T>
Polynomial rounded_minimax(const Target& t, const Polynomial& kept, int count, int one_by_one,
                           Quad unit = 1) {
  Polynomial p = kept;
  p.resize(count, 0);
  for (int k = static_cast<int>(kept.size()); k < one_by_one; ++k) {
    p = minimax(t, p, k);
    p[k] = rounded<T>(p[k], unit);
  }
  if (one_by_one < count) p = minimax(t, p, one_by_one);
  for (int k = one_by_one; k < count; ++k) p[k] = rounded<T>(p[k], unit);
  return p;
}

}  // namespace viete::test
