// Random numbers, places and directions for tests.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "base/vector.h"

namespace viete::test {

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  base::Vec3 vector(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }
  std::vector<base::Vec3> vectors(std::size_t count, double size) {
    std::vector<base::Vec3> all(count);
    for (auto& v : all) v = vector(size);
    return all;
  }

private:
  std::mt19937_64 engine_;
};

}  // namespace viete::test
