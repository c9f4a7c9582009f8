#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace spheroscope {

/// "1 cell", "0 cells", "12 cells": for every number of things that a text tells.
template <std::integral Integer>
[[nodiscard]] std::string counted(Integer n, std::string_view thing) {
    return std::to_string(n).append(" ").append(thing).append(n == 1 ? "" : "s");
}

}  // namespace spheroscope
