#include "app/bench_ensembles.h"

#include <cmath>

namespace viete::app {

namespace {

using Matrix = sym3::Sym3<double>;

// Not std::uniform_real_distribution, whose numbers differ between libraries.
double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// The rotation of a quaternion that is uniform in the ball.
std::array<std::array<double, 3>, 3> random_frame(Random& random) {
  double w, x, y, z, norm2;
  do {
    w = uniform(random, -1, 1), x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    norm2 = w * w + x * x + y * y + z * z;
  } while (norm2 > 1 || norm2 < 0.01);
  const double s = 2 / norm2;
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

template <class Make>
Matrices made(std::size_t count, Make make) {
  Random random(20160101);
  Matrices all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = make(random, i);
  return all;
}

}  // namespace

Matrix with_eigenvalues(const std::array<double, 3>& values, Random& random) {
  const auto v = random_frame(random);
  const auto entry = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += values[k] * v[i][k] * v[j][k];
    return sum;
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

Matrices paper_ensemble(std::size_t count) {
  return made(count, [](Random& random, std::size_t) -> Matrix {
    double m[3][3];
    for (auto& row : m) {
      for (double& entry : row) entry = uniform(random, -1, 1);
    }
    const auto dot = [&](int i, int j) { return m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]; };
    return {dot(0, 0), dot(0, 1), dot(0, 2), dot(1, 1), dot(1, 2), dot(2, 2)};
  });
}

Matrices uniform_entries(double low, double high, std::size_t count) {
  return made(count, [=](Random& random, std::size_t) {
    Matrix s;
    for (double* entry : {&s.xx, &s.xy, &s.xz, &s.yy, &s.yz, &s.zz}) *entry = uniform(random, low, high);
    return s;
  });
}

Matrices pairs(double gap, std::size_t count) {
  return made(count, [=](Random& random, std::size_t) {
    const double x = uniform(random, 0, 3 - gap), other = uniform(random, 0, 3);
    return with_eigenvalues({x, x + gap, other}, random);
  });
}

Matrices triples(double gap, std::size_t count) {
  return made(count, [=](Random& random, std::size_t) {
    const double x = uniform(random, 0, 3 - 2 * gap);
    return with_eigenvalues({x, x + gap, x + 2 * gap}, random);
  });
}

Matrices spreads(double spread, std::size_t count) {
  return made(count, [=](Random& random, std::size_t i) {
    const double near = spread * std::pow(10.0, uniform(random, -16, -1));
    const double middles[] = {0, spread, near, spread - near, spread / 2, uniform(random, 0, spread)};
    return with_eigenvalues({-spread / 2, middles[i % 6] - spread / 2, spread / 2}, random);
  });
}

}  // namespace viete::app
