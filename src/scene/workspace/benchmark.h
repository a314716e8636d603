// The benchmark that a person runs beside the view: how far it is, and what it found.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace viete::scene {

struct BenchmarkBar {
  std::string name;
  double ns = 0;      ///< a matrix
  bool ours = false;  ///< else what we are compared with
};

struct Benchmark {
  bool running = false;
  double done = 0;                 ///< in [0, 1]
  std::size_t count = 0;           ///< matrices; 0 until it was run
  std::vector<BenchmarkBar> bars;  ///< the first is what the others are compared with
};

}  // namespace viete::scene
