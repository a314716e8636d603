// Cases that repeat the same checks with more data: `ctest -L long`.
#pragma once

#include <cstdlib>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(longer)): such cases get an additional ctest entry with more
/// rounds.
inline constexpr const char* longer = "longer";

inline int rounds(int usual, int in_a_long_run) {
  return std::getenv("VIETE_LONG") ? in_a_long_run : usual;
}

}  // namespace viete::test
