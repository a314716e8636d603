// viete bench bind: time and memory of binding, compared with plain loops.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

struct BindOptions {
  std::filesystem::path model;
  std::filesystem::path cage;  ///< empty: a cage of `faces` triangles is generated for the model
  std::size_t count = 0;       ///< minimum number of vertices, by subdivision; 0: the model's
  std::size_t faces = 300;
  std::size_t rounds = 5;
  std::filesystem::path json;  ///< output of the numbers; empty: none
};

/// Prints the table. Throws base::Error.
void bench_bind(const BindOptions& options);

}  // namespace viete::bench
