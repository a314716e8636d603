// What this build is: the only source that is compiled anew when version or place change.
#pragma once

namespace viete::app {

/// "0.2.0".
const char* version();
/// Build type and compiler: "Release, GNU 12.2.0".
const char* build_type();
/// The assets of the sources that the program was built from.
const char* source_assets();

}  // namespace viete::app
