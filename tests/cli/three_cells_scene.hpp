#pragma once

#include "tests/scene/case_a_text.hpp"

namespace spheroscope {

/// A ball of three beads that become cells and relax for a moment.
inline const std::string k_three_cells_scene = R"(
[scene]
title = "Three cells"
[cells]
count = 3
nodes = 42
[cells.radius]
shape = 37.75
scale = "0.24 um"
min = "5 um"
max = "13 um"
)" + k_case_a_cell + case_a_contact() +
                                               R"([method]
dt_max = "0.1 s"
[[stage]]
kind = "anneal"
packing_fraction = 0.3
steps = 500
[[stage]]
kind = "relax"
duration = "0.3 s"
[measures]
fields = ["sigma_h"]
)";

}  // namespace spheroscope
