// generate_dragon FOLDER: makes the bundled dragon, its shapes, its cage, the poses of the cage and its loop.
// generate_dragon --splats FILE [COUNT]: makes a capture of the dragon, with 100,000 splats by default.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "dragon/files.h"
#include "dragon/model.h"
#include "dragon/splats.h"

namespace {

using namespace viete;

void write_splats(const char* file, std::size_t count) {
  const char* const comment = "Viete dragon as Gaussian splats, made by generate_dragon; MIT licence";
  dragon::write_whole(file, dragon::splats_file(dragon::dragon_mesh(), count, comment));
}

}  // namespace

int main(int count, char** arguments) {
  const bool splats = count > 1 && std::string_view(arguments[1]) == "--splats";
  const unsigned long long wanted = splats && count == 4 ? std::strtoull(arguments[3], nullptr, 10) : 100'000;
  if (splats ? count < 3 || count > 4 || wanted == 0 : count != 2) {
    std::fprintf(stderr,
                 "usage: generate_dragon FOLDER\nWrites dragon.ply, shape_*.pc2, cage.obj, pose_*.obj and "
                 "loop.viete there.\n\nusage: generate_dragon --splats FILE [COUNT]\n"
                 "Writes a capture of the dragon, a PLY file of 100000 Gaussian splats or COUNT.\n");
    return 2;
  }
  try {
    splats ? write_splats(arguments[2], wanted) : dragon::write_files(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_dragon: %s\n", error.what());
    return 1;
  }
  return 0;
}
