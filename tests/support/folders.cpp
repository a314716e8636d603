// The only source with absolute paths. A compiler cache can thus use all other sources in any checkout.
#include "support/data.h"

namespace viete::test {

std::filesystem::path source_dir() {
  return VIETE_SOURCE_DIR;
}

std::filesystem::path build_dir() {
  return VIETE_BUILD_DIR;
}

}  // namespace viete::test
