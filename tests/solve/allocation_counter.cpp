#include "tests/solve/allocation_counter.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Clang's thread sanitizer has operators of its own, which cannot be replaced.
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SPHEROSCOPE_KEEPS_OPERATORS
#endif
#endif

namespace {
std::atomic<std::int64_t> n_allocations{0};
}

std::int64_t spheroscope::test::allocations() {
    return n_allocations.load(std::memory_order_relaxed);
}

#ifdef SPHEROSCOPE_KEEPS_OPERATORS
bool spheroscope::test::counts_allocations() { return false; }
#else
bool spheroscope::test::counts_allocations() { return true; }

namespace {
void* counted(std::size_t size, std::size_t alignment) {
    n_allocations.fetch_add(1, std::memory_order_relaxed);
    // aligned_alloc wants a multiple of the alignment, and not zero.
    const std::size_t rounded = (size + alignment) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, rounded);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
}  // namespace

// The other forms of new and delete of the standard library call these.
void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
