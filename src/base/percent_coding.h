// Bytes by two hexadecimal digits behind a percent sign, as in URIs (RFC 3986).
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// What is not plain is coded; the percent sign is to be among that.
std::string percent_encoded(std::string_view bytes, bool (*is_plain)(char));

/// A percent sign without two digits behind it stays as it is, and then *whole (may be null) becomes false.
std::string percent_decoded(std::string_view text, bool* whole = nullptr);

}  // namespace viete::base
