// Arrays aligned for vector code, and how much memory is left.
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viete::base {

/// Starts at a cache line. From some megabytes on the system is asked for large pages, which spare it looking
/// up addresses: arrays that are read from memory once a frame come up to a third faster. Throws
/// std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory);

template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  // Elements that are given no value get none: large arrays are first written where they are computed.
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

/// Bytes that the system can give without swapping; nothing where it does not say. Thread-safe.
std::optional<double> free_memory();

/// What memory is wanted for, as base::Error says it.
struct MemoryNeed {
  double bytes;
  std::string taker;   ///< "1000 matrices take"
  std::string advice;  ///< "give a smaller number"
  std::string place;
};

/// Throws base::Error when more than nine tenths of the memory that is free are needed. Passes where the
/// system does not say how much that is. Thread-safe.
void require_memory(const MemoryNeed& need);

/// The same error, when memory has run out.
[[noreturn]] void refuse_memory(const MemoryNeed& need);

}  // namespace viete::base
