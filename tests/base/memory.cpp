#include "base/memory.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"

using namespace viete;

TEST_CASE("free_memory_is_some_where_the_system_says") {
  if (const auto bytes = base::free_memory()) CHECK(*bytes > 1e6);
}

TEST_CASE("what_does_not_fit_into_memory_is_refused_with_its_size") {
  base::require_memory({1, "one byte takes", "", ""});
  try {
    base::refuse_memory({160e9, "1,000 matrices take", "give a smaller number", "--count"});
  } catch (const base::Error& error) {
    CHECK(std::string(error.what()).find("--count: 1,000 matrices take 160.0 GB of memory") == 0);
  }
}
