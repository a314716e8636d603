#include "base/memory.h"

#include "base/error.h"
#include "base/os.h"
#include "base/text.h"

namespace viete::base {

namespace {

constexpr std::size_t line = 64;
constexpr std::size_t large_page = std::size_t{2} << 20;

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  const std::size_t alignment = bytes >= large_page ? large_page : line;
  const std::size_t size = (bytes + line - 1) / line * line;
  void* const memory = size < bytes ? nullptr : os::allocate_aligned(alignment, size);
  if (!memory) throw std::bad_alloc();
  if (alignment == large_page) os::use_large_pages(memory, size);
  return memory;
}

void free_aligned(void* memory) {
  os::free_aligned(memory);
}

void refuse_memory(const MemoryNeed& need) {
  const auto free = os::free_memory();
  const std::string rest = free ? ", of which " + memory_size(*free) + " are free" : "";
  throw Error(need.place, need.taker + " " + memory_size(need.bytes) + " of memory" + rest, need.advice);
}

void require_memory(const MemoryNeed& need) {
  const auto free = os::free_memory();
  if (free && need.bytes > 0.9 * *free) refuse_memory(need);
}

}  // namespace viete::base
