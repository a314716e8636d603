// The only source with absolute paths. A compiler cache can thus share all other results between checkouts.
#include "support/data.h"

namespace viete::test {

std::filesystem::path source_dir() {
  return VIETE_SOURCE_DIR;
}

std::filesystem::path build_dir() {
  return VIETE_BUILD_DIR;
}

}  // namespace viete::test
