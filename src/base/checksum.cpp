#include "base/checksum.h"

#include <algorithm>
#include <cstring>

namespace viete::base {

namespace {

// For one word a bijection of the state, for one state a bijection of the word.
std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x9e3779b97f4a7c15;  // odd: 2^64 over the golden ratio
  return state ^ state >> 32;
}

}  // namespace

// Four chains: one would wait for its multiplications.
void Checksum::add(const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  for (std::size_t left = size; left > 0;) {
    std::array<std::uint64_t, 4> words{};
    const std::size_t taken = std::min(left, sizeof words);
    std::memcpy(words.data(), at, taken);
    for (std::size_t i = 0; i < words.size(); ++i) lanes_[i] = mix(lanes_[i], words[i]);
    at += taken;
    left -= taken;
  }
  lanes_[0] = mix(lanes_[0], size);
}

std::uint64_t Checksum::value() const {
  std::uint64_t value = 0;
  for (const auto lane : lanes_) value = mix(value, lane);
  return value;
}

}  // namespace viete::base
