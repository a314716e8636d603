// The manual's pages, built from assets/manual.
#pragma once

#include <filesystem>
#include <string>

namespace viete::app {

/// The page file of chapter "cages", for example; empty: the first page. In the build or install folder.
/// Throws base::Error for an unknown chapter, listing the existing ones, or if the pages were not built.
std::filesystem::path manual_page(const std::string& chapter);

}  // namespace viete::app
