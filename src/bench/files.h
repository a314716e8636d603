// viete bench files: how fast a model is read and written.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

struct FilesOptions {
  std::filesystem::path model;  ///< empty: an OBJ of a million triangles is made, with vt and vn
  std::size_t rounds = 5;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// Prints the table: reading beside a plain read of the bytes and the reader of OpenMesh, and writing the
/// deformed file again, into memory. Throws base::Error.
void bench_files(const FilesOptions& options);

}  // namespace viete::bench
