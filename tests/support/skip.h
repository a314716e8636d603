// Marks test cases that have special requirements (real meshes, a display, much memory) or longer runs
// (`ctest -L long`).
#pragma once

#include <cstdlib>
#include <string>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(if_present)) marks a case that may be skipped. These cases have a
/// separate ctest entry. If one of them is skipped, the entry is shown as skipped.
inline constexpr const char* if_present = "if_present";

/// Prints the reason. The case must return after this call. The test exits with code 77; other ctest entries
/// treat this code as a failure.
void skip(const std::string& why);

/// TEST_CASE("name" * doctest::test_suite(longer)) marks a case with an additional ctest entry. In this
/// entry, the case runs more rounds.
inline constexpr const char* longer = "longer";

inline int rounds(int usual, int in_a_long_run) {
  return std::getenv("VIETE_LONG") ? in_a_long_run : usual;
}

}  // namespace viete::test
