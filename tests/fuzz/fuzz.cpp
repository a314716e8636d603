// The fuzzer of all formats. The name of the corpus folder, the first argument, selects the check. The
// functions below are called by libFuzzer if VIETE_LIBFUZZER is set, otherwise by driver.cpp.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "fuzz/checks.h"

namespace {

using namespace viete;
using Check = std::function<void(std::string_view)>;

Check reads(fuzz::Reader* reader, std::size_t placed = 0) {
  return [=](std::string_view bytes) { fuzz::check_reader(reader, placed, bytes); };
}

const std::map<std::string, Check> checks = {{"obj", reads(formats::read_obj)},
                                             {"ply", reads(formats::read_ply)},
                                             {"off", reads(formats::read_off)},
                                             {"stl", reads(formats::read_stl)},
                                             {"gltf", reads(formats::read_gltf, 1 << 22)},
                                             {"mtl", fuzz::check_materials},
                                             {"point_cache", fuzz::check_point_cache},
                                             {"image", fuzz::check_picture}};

Check check;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  for (int i = 1; i < *count && !check; ++i) {
    const auto found = checks.find(std::filesystem::path((*arguments)[i]).filename().string());
    if (found != checks.end()) check = found->second;
  }
  if (check) return 0;
  std::fprintf(stderr, "usage: %s FOLDER/corpus/FORMAT; the folder's name must be a format\n",
               (*arguments)[0]);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check({reinterpret_cast<const char*>(data), size});
  return 0;
}
