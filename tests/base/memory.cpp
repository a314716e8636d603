#include "base/memory.h"

#include <doctest/doctest.h>

TEST_CASE("free_memory_is_some_where_the_system_says") {
  if (const auto bytes = viete::base::free_memory()) CHECK(*bytes > 1e6);
}
