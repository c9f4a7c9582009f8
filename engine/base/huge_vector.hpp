#pragma once

#include <cstddef>
#include <vector>

namespace spheroscope {

/// Memory for arrays that are read from one end to the other in every iteration. Large ones are
/// asked for in pages of 2 MB, where the system has them: on small pages a core reads no faster
/// than it finds the next page (10 instead of 18 GB/s from 32 MB on, on an Intel Xeon under a
/// hypervisor).
namespace huge_memory {
/// Throws std::bad_alloc. Begins at a cache line.
[[nodiscard]] void* allocate(std::size_t n_bytes);
void release(void* memory) noexcept;
}  // namespace huge_memory

template <class T> struct HugeAllocator {
    using value_type = T;
    static_assert(alignof(T) <= 64);

    HugeAllocator() = default;
    template <class U> HugeAllocator(const HugeAllocator<U>&) {}

    [[nodiscard]] T* allocate(std::size_t n) {
        return static_cast<T*>(huge_memory::allocate(n * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t) noexcept { huge_memory::release(memory); }
    template <class U> bool operator==(const HugeAllocator<U>&) const { return true; }
};

template <class T> using HugeVector = std::vector<T, HugeAllocator<T>>;

}  // namespace spheroscope
