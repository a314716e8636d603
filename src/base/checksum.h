// A number that tells whether bytes are still the same, at the speed of memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace viete::base {

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
