#include "engine/base/huge_vector.hpp"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace spheroscope::huge_memory {
namespace {

constexpr std::size_t k_line = 64;
constexpr std::size_t k_huge_page = std::size_t{1} << 21;
/// Smaller arrays would waste most of their last page.
constexpr std::size_t k_fewest_bytes = k_huge_page;

}  // namespace

void* allocate(std::size_t n_bytes) {
    const bool is_huge = n_bytes >= k_fewest_bytes;
    const std::size_t alignment = is_huge ? k_huge_page : k_line;
    if (n_bytes > static_cast<std::size_t>(-1) - alignment) throw std::bad_alloc();
    void* const memory =
        std::aligned_alloc(alignment, (n_bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    // Only whole pages, so that no more memory is taken than asked for. A system that has no such
    // pages says so, and small ones do.
    if (is_huge)
        static_cast<void>(madvise(memory, n_bytes / k_huge_page * k_huge_page, MADV_HUGEPAGE));
#endif
    return memory;
}

void release(void* memory) noexcept { std::free(memory); }

}  // namespace spheroscope::huge_memory
