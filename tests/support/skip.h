// Cases with special requirements: real meshes, a display, much memory.
#pragma once

#include <string>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(if_present)): such cases get a ctest entry of their own, which is
/// shown as skipped if one of them is.
inline constexpr const char* if_present = "if_present";

/// Prints the reason; the case must then return. A test that passed with skipped cases exits with 77, which
/// counts as a failure in the entries of all other cases.
void skip(const std::string& why);

}  // namespace viete::test
