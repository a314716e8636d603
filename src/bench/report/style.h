// How the page looks: on a screen by day and by night, on a phone, on paper.
#pragma once

#include <string>

namespace viete::bench {

/// CSS.
std::string page_style();

}  // namespace viete::bench
