// Files of the bundled model.
#pragma once

#include "support/data.h"

namespace viete::test {

/// `dragon` is `bundled_dragon` simplified to 3,000 vertices, for tests that do not compare pictures.
inline const std::filesystem::path bundled_dragon = assets_dir() / "dragon" / "dragon.ply",
                                   dragon = source_dir() / "tests" / "program" / "dragon.ply",
                                   dragon_cage = assets_dir() / "dragon" / "cage.obj";

}  // namespace viete::test
