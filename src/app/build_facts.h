// Facts about this build: the only source recompiled when version or location change.
#pragma once

namespace viete::app {

/// "0.2.0".
const char* version();
/// Build type and compiler: "Release, GNU 12.2.0".
const char* build_type();
/// The assets folder of the source tree it was built from.
const char* source_assets();

}  // namespace viete::app
