// Base64 (RFC 4648), percent coding (RFC 3986) and a checksum of bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace viete::base {

std::string base64(std::string_view bytes);
/// Nothing if there is another character in it than its letters; ends at a "=".
std::optional<std::string> bytes_of_base64(std::string_view text);

/// What is not plain is coded; the percent sign is to be among that.
std::string percent_encoded(std::string_view bytes, bool (*is_plain)(char));

/// A percent sign without two digits behind it stays as it is, and then *whole (may be null) becomes false.
std::string percent_decoded(std::string_view text, bool* whole = nullptr);

/// 64 bits of everything that was added, call by call: the same bytes in other portions give another value.
/// Whatever changes within one aligned run of 8 bytes changes the value for certain, anything else but for
/// one chance in 2^64. Against accidents, not against malice. Depends on the machine's byte order.
class Checksum {
public:
  void add(const void* bytes, std::size_t size);
  std::uint64_t value() const;

private:
  std::array<std::uint64_t, 4> lanes_{};
};

}  // namespace viete::base
