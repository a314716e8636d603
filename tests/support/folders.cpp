// The only source that knows the folders by name: all others compile the same wherever the checkout lies.
#include "support/data.h"

namespace viete::test {

std::filesystem::path source_dir() {
  return VIETE_SOURCE_DIR;
}

std::filesystem::path build_dir() {
  return VIETE_BUILD_DIR;
}

}  // namespace viete::test
