#pragma once

#include "engine/run/snapshot.hpp"

#include <memory>

namespace spheroscope::viewer {

/// Two round cells of 162 nodes and radius 8 um that touch at the origin, cell 0 at x < 0; fields
/// sigma_h (-20 and 30 Pa), sigma_nn (NaN everywhere but on triangle 5 of cell 0: 100 Pa),
/// gamma_eff (the number of the node, in nN/um); one contact of 2 nN on 10 um^2. `h0_um`: range of
/// the scene's contacts.
[[nodiscard]] std::shared_ptr<Snapshot> two_cells(double h0_um = 0.3);

}  // namespace spheroscope::viewer
