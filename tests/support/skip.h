// Cases that need what not every machine has: real meshes, a display, much memory.
#pragma once

#include <string>

namespace viete::test {

/// TEST_CASE("name" * doctest::test_suite(if_present)): ctest runs such cases of a test in an entry of their
/// own, which it shows as skipped where one of them is.
inline constexpr const char* if_present = "if_present";

/// Says why; the case returns then. A test that passed with skipped cases exits with 77, which counts as a
/// failure in the entries of all other cases.
void skip(const std::string& why);

}  // namespace viete::test
