#include "app/assets.h"

namespace viete::app {

const char* version() {
  return VIETE_VERSION;
}

const char* build_type() {
  return VIETE_BUILD_TYPE;
}

const char* source_assets() {
  return VIETE_SOURCE_ASSETS;
}

}  // namespace viete::app
