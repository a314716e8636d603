// Test cases with special requirements (real meshes, a display, much memory) or longer runs (`ctest -L
// long`).
#pragma once

#include <cstdlib>
#include <string>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(if_present)) marks cases that may be skipped. They have a separate
/// ctest entry, which is shown as skipped if a case is.
inline constexpr const char* if_present = "if_present";

/// Prints the reason; the case must then return. The test exits with 77, which is a failure in all other
/// ctest entries.
void skip(const std::string& why);

/// TEST_CASE("name" * doctest::test_suite(longer)) marks cases that have another ctest entry, with more
/// rounds.
inline constexpr const char* longer = "longer";

inline int rounds(int usual, int in_a_long_run) {
  return std::getenv("VIETE_LONG") ? in_a_long_run : usual;
}

}  // namespace viete::test
