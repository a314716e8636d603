// viete bench bind: what binding costs, against plain loops, in time and memory.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

struct BindOptions {
  std::filesystem::path model;
  std::filesystem::path cage;  ///< empty: one of `faces` triangles is made for the model
  std::size_t count = 0;       ///< vertices at least, by subdivision; 0: those of the model
  std::size_t faces = 300;
  std::size_t rounds = 5;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Prints the table. Throws base::Error.
void bench_bind(const BindOptions& options);

}  // namespace viete::bench
