// Base64 (RFC 4648), percent-encoding (RFC 3986) and a checksum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace viete::base {

std::string base64(std::string_view bytes);
/// Decodes Base64 up to the first "=". If a character is not in the Base64 alphabet, returns nullopt.
std::optional<std::string> bytes_of_base64(std::string_view text);

/// Percent-encodes all bytes for which is_plain() is false. is_plain() must be false for the percent sign.
std::string percent_encoded(std::string_view bytes, bool (*is_plain)(char));

/// Decodes percent-encoding. If a percent sign is not followed by two hexadecimal digits, keeps the percent
/// sign and sets *whole to false. `whole` may be null.
std::string percent_decoded(std::string_view text, bool* whole = nullptr);

/// A 64-bit checksum of the bytes in all calls of add(); not cryptographic. It also depends on the size in
/// each call, and on the processor's byte order. A change within 8 aligned bytes always changes the checksum.
/// Any other change leaves the checksum unchanged with a probability of about 2^-64.
class Checksum {
public:
  void add(const void* bytes, std::size_t size);
  std::uint64_t value() const;

private:
  std::array<std::uint64_t, 4> lanes_{};
};

}  // namespace viete::base
