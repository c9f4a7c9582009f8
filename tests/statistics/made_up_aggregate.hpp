#pragma once

#include "engine/statistics/aggregate.hpp"

namespace spheroscope::test {

/// Round cells of one radius at these centres, without contacts or stress; all arrays have their
/// sizes, and tests fill in what they look at.
[[nodiscard]] statistics::Aggregate round_cells(const std::vector<Vec3>& centres_um,
                                                double radius_um, int n_nodes = 162);

}  // namespace spheroscope::test
