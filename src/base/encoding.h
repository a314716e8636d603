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
/// Nothing if the text has a character outside the Base64 alphabet; stops at a "=".
std::optional<std::string> bytes_of_base64(std::string_view text);

/// Encodes bytes that are not plain; the percent sign must not be plain.
std::string percent_encoded(std::string_view bytes, bool (*is_plain)(char));

/// A percent sign without two hex digits is kept, and *whole (may be null) becomes false.
std::string percent_decoded(std::string_view text, bool* whole = nullptr);

/// 64-bit checksum of all added bytes; depends on how they are split into calls. Any change within one
/// aligned run of 8 bytes changes the value; other changes go undetected with probability 2^-64. Not
/// cryptographic. Depends on the machine's byte order.
class Checksum {
public:
  void add(const void* bytes, std::size_t size);
  std::uint64_t value() const;

private:
  std::array<std::uint64_t, 4> lanes_{};
};

}  // namespace viete::base
