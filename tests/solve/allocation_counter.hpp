#pragma once

#include <cstdint>

namespace spheroscope::test {

/// Calls of the global operator new in this program so far, by all threads.
[[nodiscard]] std::int64_t allocations();
/// Whether they are counted: not where operator new cannot be replaced.
[[nodiscard]] bool counts_allocations();

}  // namespace spheroscope::test
