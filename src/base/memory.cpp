#include "base/memory.h"

#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "base/text.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
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
  if (alignment == large_page) madvise(memory, size, MADV_HUGEPAGE);  // a failure only costs speed
#endif
  return memory;
}

void free_aligned(void* memory) {
  std::free(memory);
}

void release_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_MAX, 0);         // no array is a mapping of its own, which would end with the array
  mallopt(M_TRIM_THRESHOLD, -1);  // the heap does not shrink
#endif
}

std::optional<double> free_memory() {
  std::ifstream in("/proc/meminfo");
  std::string key, unit;
  double kilobytes = 0;
  while (in >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, unit);
  }
  return std::nullopt;
}

void refuse_memory(const MemoryNeed& need) {
  const auto free = free_memory();
  const std::string rest = free ? ", of which " + memory_size(*free) + " are free" : "";
  throw Error(need.place, need.taker + " " + memory_size(need.bytes) + " of memory" + rest, need.advice);
}

void require_memory(const MemoryNeed& need) {
  const auto free = free_memory();
  if (free && need.bytes > 0.9 * *free) refuse_memory(need);
}

}  // namespace viete::base
