// The manual as pages, which the build makes of assets/manual.
#pragma once

#include <filesystem>
#include <string>

namespace viete::app {

/// A chapter, "cages"; empty: the first page. Beside the program, or where it is installed. Throws
/// base::Error where there is no such chapter, naming those there are, or where the pages were not made.
std::filesystem::path manual_page(const std::string& chapter);

}  // namespace viete::app
