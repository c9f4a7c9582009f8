#pragma once

#include "tests/reference/made_up_cells.hpp"

namespace spheroscope::test {

/// Thirteen cells, one in the middle and twelve around it as in a face-centred cubic lattice,
/// pressed together: every node beyond the plane halfway to a neighbour lies gap_um / 2 before that
/// plane. So cells have flat contacts that meet in edges, and round sides outside; every cell's
/// mesh is turned at random, with normal noise on the nodes.
[[nodiscard]] Cluster make_compacted_ball(int n_nodes, std::uint64_t seed, double gap_um,
                                          double noise_um);

}  // namespace spheroscope::test
