// Cases that prove the same by more of the same, where there is time: `ctest -L long`.
#pragma once

#include <cstdlib>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(longer)): such cases have another entry in ctest, too, with more
/// rounds.
inline constexpr const char* longer = "longer";

inline int rounds(int usual, int in_a_long_run) {
  return std::getenv("VIETE_LONG") ? in_a_long_run : usual;
}

}  // namespace viete::test
