#include "formats/mtl.h"
#include "fuzz/checks.h"

void viete::fuzz::check_materials(std::string_view bytes) {
  const viete::formats::Source source{"fuzz", "mtl", bytes, nullptr, nullptr, "/folder"};
  const auto materials = viete::formats::read_mtl(source);
  require(materials.size() <= bytes.size());
  for (const auto& m : materials) {
    for (const float x : m.material.base_color) {
      require(x >= 0 && x <= 1);
    }
    require(m.image.empty() || m.image.is_absolute());
  }
}
