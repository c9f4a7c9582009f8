#pragma once

#include "tests/scene/case_a_text.hpp"

namespace spheroscope {

/// One cell of 42 nodes that comes back from a stretch: smooth, so orders show. `method_keys` are
/// lines of [method].
inline std::string stretched_cell_text(const std::string& duration,
                                       const std::string& method_keys = "") {
    return R"([cells]
arrangement = "single"
nodes = 42
radius = 9
[start]
stretch = [1.05, 0.98, 0.97]
)" + k_case_a_cell +
           "[method]\n" + method_keys + "[[stage]]\nkind = \"relax\"\nduration = \"" + duration +
           "\"\n";
}

}  // namespace spheroscope
