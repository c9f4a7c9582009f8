#pragma once

namespace spheroscope {

/// A ball of three beads that become cells and relax for a moment.
inline constexpr const char* k_three_cells_scene = R"(
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
[cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
K = "5 kPa"
[medium]
[contact]
law = "traction"
[contact.adhesion]
omega = "0.5 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[method]
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
