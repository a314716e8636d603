// The manual's pages, built from assets/manual.
#pragma once

#include <filesystem>
#include <string>

namespace viete::app {

/// The page of a chapter, "cages"; empty: the first page. Next to the program, or in the install folder.
/// Throws base::Error for an unknown chapter, listing the existing ones, or if the pages were not built.
std::filesystem::path manual_page(const std::string& chapter);

}  // namespace viete::app
