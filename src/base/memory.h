// Arrays aligned for vector code, and checks of free memory.
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viete::base {

/// Aligned to a cache line. Requests large pages for some megabytes or more, which reduces TLB misses: arrays
/// that are read from memory once per frame are up to a third faster. Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory);

template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  // Default initialisation: large arrays are first written by the threads that compute them.
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

/// Bytes available without swapping; nothing if the system does not report it. Thread-safe.
std::optional<double> free_memory();

/// A memory requirement, with the texts of its base::Error.
struct MemoryNeed {
  double bytes;
  std::string taker;   ///< start of the message: "1000 matrices take"
  std::string advice;  ///< what to do: "give a smaller number"
  std::string place;
};

/// Throws base::Error if it exceeds nine tenths of the free memory. Passes if the system does not report free
/// memory. Thread-safe.
void require_memory(const MemoryNeed& need);

/// Throws the same error after an allocation failed.
[[noreturn]] void refuse_memory(const MemoryNeed& need);

}  // namespace viete::base
