// The program viete-import reads a file and writes a scene to the standard output; with --decompress, reads a
// compressed glTF file and writes a GLB without compression. Prints the progress to the standard error.
// foreign/read.cpp starts this program.

#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>

#include "base/file_bytes.h"
#include "base/os.h"
#include "foreign/readers.h"

namespace {

using namespace viete;

std::string scene_of_file([[maybe_unused]] const std::string& file) {
#ifdef VIETE_ASSIMP
  return bytes_of(foreign::scene_by_assimp(file));
#else
  throw std::runtime_error("viete-import was built without Assimp (libassimp-dev)");
#endif
}

std::string output_or_failure(const std::string& file, bool decompresses) {
  foreign::Scene scene;
  try {
    return decompresses ? foreign::decompressed_gltf(file) : scene_of_file(file);
  } catch (const std::bad_alloc&) {
    scene.failure = "it needs too much memory";
  } catch (const std::exception& error) {
    scene.failure = *error.what() ? error.what() : "it gives no reason";
    if (scene.failure.starts_with(file + ": ")) scene.failure.erase(0, file.size() + 2);
  }
  return bytes_of(scene);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double usual_memory = 4e9;
  const auto words = base::os::start_program(argc, argv);
  const bool decompresses = words.size() == 2 && words.front() == "--decompress";
  if (words.size() != 1 && !decompresses) {
    std::fputs("usage: viete-import [--decompress] FILE; viete runs this program to read files\n", stderr);
    return 2;
  }
  std::FILE* const output = base::os::reserve_output();
  base::os::limit_process(base::os::total_memory().value_or(usual_memory), foreign::most_seconds);
  base::os::confine_process({words.back(), base::folder_of(words.back())});
  const std::string bytes = output_or_failure(words.back(), decompresses);
  const bool written = output && std::fwrite(bytes.data(), 1, bytes.size(), output) == bytes.size();
  return written && std::fclose(output) == 0 ? 0 : 1;
}
