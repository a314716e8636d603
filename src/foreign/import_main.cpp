// The program viete-import FILE: reads the file with Assimp and writes a scene to the standard output. Prints
// the progress to the standard error. foreign/read.cpp starts this program.
#include <cstdio>
#include <exception>
#include <string>

#include "base/os.h"
#include "foreign/assimp_reader.h"

namespace {

namespace os = viete::base::os;

constexpr unsigned most_seconds = 600;  // processor time
constexpr double usual_memory = 4e9;

void print_percent(double done) {
  static int printed = -1;
  const int percent = static_cast<int>(100 * done);
  if (percent <= printed || percent > 100) return;
  printed = percent;
  std::fprintf(stderr, "%d %%\n", percent);
}

viete::foreign::Scene scene_of(const std::string& file) {
  viete::foreign::Scene scene;
  try {
    return viete::foreign::read_with_assimp(file, print_percent);
  } catch (const std::bad_alloc&) {
    scene.failure = "it needs more memory than this computer has";
  } catch (const std::exception& error) {
    scene.failure = *error.what() ? error.what() : "Assimp gives no reason";
  }
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const auto words = os::start_program(argc, argv);
  if (words.size() != 1) {
    std::fputs("usage: viete-import FILE; viete runs this program to read files with Assimp\n", stderr);
    return 2;
  }
  std::FILE* const output = os::reserve_output();
  os::limit_process(os::total_memory().value_or(usual_memory), most_seconds);
  const std::string bytes = viete::foreign::bytes_of(scene_of(words.front()));
  const bool written = output && std::fwrite(bytes.data(), 1, bytes.size(), output) == bytes.size();
  return written && std::fclose(output) == 0 ? 0 : 1;
}
