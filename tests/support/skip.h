// Marks test cases that need real meshes, a display or much memory, and test cases with longer runs.
#pragma once

#include <cstdlib>
#include <string>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(if_present)) marks a case that may call skip(). These cases have a
/// separate ctest entry. If a case calls skip(), ctest shows this entry as skipped.
inline constexpr const char* if_present = "if_present";

/// Prints the reason. The case must return after this call. The program then exits with code 77. ctest shows
/// the if_present entries as skipped, and other entries as failed.
void skip(const std::string& why);

/// TEST_CASE("name" * doctest::test_suite(longer)) marks a case that also runs in `ctest -L long`, where
/// rounds() returns a larger number.
inline constexpr const char* longer = "longer";

inline int rounds(int usual, int in_a_long_run) {
  return std::getenv("VIETE_LONG") ? in_a_long_run : usual;
}

}  // namespace viete::test
