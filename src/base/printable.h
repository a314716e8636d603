// Text of files in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viete::base {

/// The text as it may stand in a line that is shown or printed, whatever it holds: control characters become
/// visible ("\x1B", "\n"), so that no file moves the cursor of a terminal or begins a line; of more than
/// `most` bytes the middle gives way to "...". Letters of UTF-8 stay whole.
std::string printable(std::string_view text, std::size_t most = 2000);

}  // namespace viete::base
