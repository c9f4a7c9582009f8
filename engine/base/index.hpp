#pragma once

#include <cstddef>

namespace spheroscope {

/// The number of a cell, node or triangle as a place in a container. Precondition: not negative.
[[nodiscard]] constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }

}  // namespace spheroscope
