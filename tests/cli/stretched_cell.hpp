#pragma once

#include <string>

namespace spheroscope {

/// One cell of 42 nodes that comes back from a stretch for 32 ms.
inline const std::string k_stretched_cell = R"([cells]
arrangement = "single"
nodes = 42
radius = 9
[start]
stretch = [1.05, 0.98, 0.97]
[cortex.elastic]
E = 20
[cortex.tension]
gamma = 0.5
[cortex.viscosity]
eta = 1
[cytosol]
[medium]
[method]
dt = "4 ms"
[[stage]]
kind = "relax"
duration = "0.032 s"
)";

}  // namespace spheroscope
