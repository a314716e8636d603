#include "base/memory.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>

using namespace viete;

TEST_CASE("arrays_start_at_a_cache_line_whatever_their_size") {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{64}, std::size_t{1000}, std::size_t{5} << 20}) {
    void* memory = base::allocate_aligned(bytes);
    CHECK(reinterpret_cast<std::uintptr_t>(memory) % 64 == 0);
    std::memset(memory, 1, bytes);
    base::free_aligned(memory);
  }
}

TEST_CASE("arrays_that_cannot_be_had_are_refused") {
  CHECK_THROWS_AS(base::allocate_aligned(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
}
