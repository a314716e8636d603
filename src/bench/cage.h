// viete bench cage: cages made around a model, beside the lazy way to one.
#pragma once

#include <filesystem>

namespace viete::bench {

struct CageOptions {
  std::filesystem::path model;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Prints the table: of 60, 200 and 600 triangles, time, volume and distances. Throws base::Error.
void bench_cage(const CageOptions& options);

}  // namespace viete::bench
