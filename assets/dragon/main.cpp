// generate_dragon FOLDER: makes the bundled dragon, its shapes, its cage, the poses of the cage and its loop.
#include <cstdio>
#include <exception>

#include "dragon/model.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr,
                 "usage: generate_dragon FOLDER\nWrites dragon.ply, shape_*.pc2, cage.obj, pose_*.obj and "
                 "loop.viete there.\n");
    return 2;
  }
  try {
    viete::dragon::write_files(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_dragon: %s\n", error.what());
    return 1;
  }
  return 0;
}
