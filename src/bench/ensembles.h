// Random matrices with fixed seeds, to measure errors and times.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "sym3/sym3.h"

namespace viete::bench::ensembles {

using sym3::Sym3;
using Random = std::mt19937_64;

/// Returns a uniform number in [low, high). std::uniform_real_distribution gives different numbers with
/// different libraries.
inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Returns a uniformly distributed rotation, computed from a uniform quaternion in the unit ball.
inline std::array<std::array<double, 3>, 3> random_rotation(Random& random) {
  double w, x, y, z, norm2;
  do {
    w = uniform(random, -1, 1);
    x = uniform(random, -1, 1);
    y = uniform(random, -1, 1);
    z = uniform(random, -1, 1);
    norm2 = w * w + x * x + y * y + z * z;
  } while (norm2 > 1 || norm2 < 0.01);
  const double s = 2 / norm2;
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

/// Returns a matrix with these eigenvalues, up to rounding, and with random orthonormal eigenvectors.
template <class T>
Sym3<T> with_eigenvalues(const std::array<double, 3>& values, Random& random) {
  const auto v = random_rotation(random);
  const auto entry = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += values[k] * v[i][k] * v[j][k];
    return static_cast<T>(sum);
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// Returns `count` matrices. Matrix i is make(random, i).
template <class T, class Make>
std::vector<Sym3<T>> made(std::size_t count, unsigned seed, const Make& make) {
  Random random(seed);
  std::vector<Sym3<T>> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = make(random, i);
  return all;
}

inline constexpr unsigned usual_seed = 20160101;

/// Returns the paper's ensemble: S = M M^T, entries of M uniform in [-1, 1].
template <class T>
std::vector<Sym3<T>> paper_ensemble(std::size_t count, unsigned seed = usual_seed) {
  return made<T>(count, seed, [](Random& random, std::size_t) -> Sym3<T> {
    double m[3][3];
    for (auto& row : m)
      for (double& x : row) x = uniform(random, -1, 1);
    const auto dot = [&](int i, int j) {
      return static_cast<T>(m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]);
    };
    return {dot(0, 0), dot(0, 1), dot(0, 2), dot(1, 1), dot(1, 2), dot(2, 2)};
  });
}

/// Returns matrices whose six numbers are uniform in [low, high].
template <class T>
std::vector<Sym3<T>> uniform_entries(double low, double high, std::size_t count) {
  return made<T>(count, usual_seed, [=](Random& random, std::size_t) {
    Sym3<T> s;
    for (T* x : {&s.xx, &s.xy, &s.xz, &s.yy, &s.yz, &s.zz}) *x = static_cast<T>(uniform(random, low, high));
    return s;
  });
}

/// Returns matrices with eigenvalues in [0, 3]. Two eigenvalues are `gap` apart; the third is random.
template <class T>
std::vector<Sym3<T>> pairs(double gap, std::size_t count) {
  return made<T>(count, usual_seed, [=](Random& random, std::size_t) {
    const double x = uniform(random, 0, 3 - gap), other = uniform(random, 0, 3);
    return with_eigenvalues<T>({x, x + gap, other}, random);
  });
}

/// Returns matrices with three equally spaced eigenvalues in [0, 3], `gap` apart.
template <class T>
std::vector<Sym3<T>> triples(double gap, std::size_t count) {
  return made<T>(count, usual_seed, [=](Random& random, std::size_t) {
    const double x = uniform(random, 0, 3 - 2 * gap);
    return with_eigenvalues<T>({x, x + gap, x + 2 * gap}, random);
  });
}

/// Returns matrices with eigenvalues from `lowest` to lowest + spread. The middle eigenvalue is equal to
/// one of these two, close to one of them, or anywhere between them.
template <class T>
std::vector<Sym3<T>> spreads(double spread, double lowest, std::size_t count) {
  return made<T>(count, usual_seed, [=](Random& random, std::size_t i) {
    const double near = spread * std::pow(10.0, uniform(random, -16, -1));
    const double middles[] = {0, spread, near, spread - near, spread / 2, uniform(random, 0, spread)};
    return with_eigenvalues<T>({lowest, lowest + middles[i % 6], lowest + spread}, random);
  });
}

}  // namespace viete::bench::ensembles
