#include <doctest/doctest.h>
#include <set>

#include "base/encoding.h"

using viete::base::Checksum;

namespace {

std::uint64_t checksum(const std::string& bytes) {
  Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

}  // namespace

TEST_CASE("every_flipped_bit_and_every_other_length_changes_the_checksum") {
  std::string bytes;
  std::set<std::uint64_t> seen = {checksum(bytes)};
  for (int i = 0; i < 100; ++i) {
    bytes.push_back('\0');  // add() pads with zeros, but one more zero must change the checksum
    seen.insert(checksum(bytes));
  }
  CHECK(seen.size() == 101);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = bytes;
      other[i] = static_cast<char>(1 << bit);
      seen.insert(checksum(other));
    }
  CHECK(seen.size() == 901);
}

TEST_CASE("swapped_words_change_the_checksum") {
  const std::string words = "01234567abcdefgh89ABCDEFijklmnopqrstuvwx",
                    swapped = "89ABCDEFabcdefgh01234567ijklmnopqrstuvwx";
  CHECK(checksum(words) != checksum(swapped));
  CHECK(checksum("qrstuvwx" + words) != checksum(words + "qrstuvwx"));
}
