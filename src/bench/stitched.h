// viete bench stitched: what a frame of a stitched model costs, against a plain one.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

struct StitchedOptions {
  std::filesystem::path model, cage, pose;
  std::size_t rounds = 11;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Prints the table: frames with 1 and 2 iterations, link by link; the plain frame (maps blended at each
/// triangle's centre in double, improved SD, each column solved for by Eigen's simplicial Cholesky);
/// factorisation; compare_solvers(). Throws base::Error.
void bench_stitched(const StitchedOptions& options);

}  // namespace viete::bench
