// Bytes as text, three by four letters (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viete::base {

std::string base64(std::string_view bytes);
/// Nothing if there is another character in it than its letters; ends at a "=".
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace viete::base
