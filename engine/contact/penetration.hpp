#pragma once

#include "engine/base/workers.hpp"
#include "engine/model/model.hpp"

#include <optional>
#include <span>

namespace spheroscope {

/// A node that lies inside another cell.
struct Penetration {
    int cell = 0, node = 0;  ///< node is local to its cell
    int other = 0;           ///< the cell that it lies in
    double depth_um = 0.0;   ///< its distance from that cell's surface
};

/// The deepest of all nodes [all nodes] that lie more than limit_um inside another cell; empty if
/// there is none. Contacts cannot say this: a law acts on surfaces that are near each other, and
/// two cells of which one is deep inside the other have none, or facets that face the same way.
/// Such cells feel nothing, look round and relaxed, and are wrong.
///
/// Cost: nodes in the box of another cell, less limit_um, that are farther than that from its
/// nodes. Each asks a ray along z, in a grid of that cell's triangles, whether it is inside.
[[nodiscard]] std::optional<Penetration> deepest_penetration(const Model& model,
                                                             std::span<const Vec3> x_um,
                                                             double limit_um, Workers& workers);

}  // namespace spheroscope
