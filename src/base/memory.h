// Aligned arrays, and checks of free memory.
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace viete::base {

/// Allocates memory that is aligned to a cache line. For 2 MB or more, uses large pages if the system has
/// them; reading large arrays is then up to a third faster. Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory);

template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  // Leaves numbers uninitialised: filling a large array before computing its values would waste time.
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_aligned(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t) { free_aligned(p); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// An amount of memory, and the texts of the error if the memory is not available.
struct MemoryNeed {
  double bytes;
  std::string taker;   ///< the beginning of the message, for example "1000 matrices take"
  std::string advice;  ///< for example "give a smaller number"
  std::string place;
};

/// If the amount is more than nine tenths of the free memory, throws base::Error. If the system does not
/// report free memory, does nothing. Thread-safe.
void require_memory(const MemoryNeed& need);

/// Throws the error of require_memory(). Call this after an allocation failed.
[[noreturn]] void refuse_memory(const MemoryNeed& need);

}  // namespace viete::base
