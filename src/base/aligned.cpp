#include "base/aligned.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace viete::base {

namespace {

constexpr std::size_t line = 64;
constexpr std::size_t large_page = std::size_t{2} << 20;

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  const std::size_t alignment = bytes >= large_page ? large_page : line;
  const std::size_t size = (bytes + line - 1) / line * line;
  void* memory = nullptr;
  if (size < bytes || posix_memalign(&memory, alignment, size) != 0) throw std::bad_alloc();
#if defined(__linux__)
  if (alignment == large_page) madvise(memory, size, MADV_HUGEPAGE);  // a refusal costs time alone
#endif
  return memory;
}

void free_aligned(void* memory) {
  std::free(memory);
}

}  // namespace viete::base
