#include <doctest/doctest.h>
#include <cstdint>
#include <cstring>

#include "base/error.h"
#include "base/memory.h"
#include "base/os.h"

using namespace viete;

TEST_CASE("arrays_start_at_a_cache_line_and_impossible_ones_throw") {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{64}, std::size_t{1000}, std::size_t{5} << 20}) {
    void* memory = base::allocate_aligned(bytes);
    CHECK(reinterpret_cast<std::uintptr_t>(memory) % 64 == 0);
    std::memset(memory, 1, bytes);
    base::free_aligned(memory);
  }
  CHECK_THROWS_AS(base::allocate_aligned(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
}

TEST_CASE("excessive_memory_needs_are_rejected_with_their_size") {
  if (const auto bytes = base::os::free_memory()) CHECK(*bytes > 1e6);
  base::require_memory({1, "one byte takes", "", ""});
  CHECK_THROWS_WITH_AS(
      base::refuse_memory({160e9, "1,000 matrices take", "give a smaller number", "--count"}),
      doctest::Contains("--count: 1,000 matrices take 160.0 GB of memory"), base::Error);
}
