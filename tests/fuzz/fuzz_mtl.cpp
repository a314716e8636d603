// Reads an input as a material library. The result must be materials with valid numbers.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "formats/mtl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const viete::formats::Source source{"fuzz", "mtl", bytes, nullptr, nullptr, "/folder"};
  const auto materials = viete::formats::read_mtl(source);
  if (materials.size() > size) std::abort();
  for (const auto& m : materials) {
    for (const float x : m.material.base_color) {
      if (!(x >= 0 && x <= 1)) std::abort();
    }
    if (!m.image.empty() && !m.image.is_absolute()) std::abort();
  }
  return 0;
}
