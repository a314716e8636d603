// viete bench shapes: what lies between shapes of a model and what poses it by examples, beside straight
// lines and plain loops.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace viete::bench {

struct ShapesOptions {
  std::filesystem::path rest;  ///< empty: a bar of 50,000 vertices, bent and twisted
  std::vector<std::filesystem::path> shapes;
  std::filesystem::path published;  ///< a folder with lion and horse, whose bars are checked; empty: none
  std::size_t rounds = 11;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Prints the tables. Throws base::Error.
void bench_shapes(const ShapesOptions& options);

}  // namespace viete::bench
