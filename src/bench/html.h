// Elements of an HTML page that is also XML: every value escaped, every element closed.
#pragma once

#include <string>
#include <string_view>

#include "bench/table.h"

namespace viete::bench {

/// A paragraph of text, <p class="...">; without a class if `kind` is empty.
std::string paragraph(std::string_view text, std::string_view kind = "");

/// Scrolls horizontally on narrow pages.
std::string html(const Table& table);

/// A drawing with its title, which is also its accessible name.
std::string figure(std::string_view title, std::string_view svg);

}  // namespace viete::bench
