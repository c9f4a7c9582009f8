#pragma once

#include "engine/statistics/aggregate.hpp"

#include <array>
#include <string_view>

namespace spheroscope::statistics {

/// Parts of an aggregate's surfaces between which gamma_eff differs. Cells that are not core cells
/// form the rim layer; a free node has no touching triangle around it.
enum class Region {
    rim,         ///< free nodes of the rim layer that face away from the aggregate's middle
    inner_face,  ///< touching nodes of the rim layer that face the middle, within 60 degrees
    core,        ///< touching nodes of core cells
    pore_wall,   ///< free nodes of core cells: they face a pore
};
inline constexpr std::array k_regions{Region::rim, Region::inner_face, Region::core,
                                      Region::pore_wall};
[[nodiscard]] std::string_view name_of(Region region);  ///< "inner face of the rim"

/// Mean elastic tension of each region, nN/um, in the order of k_regions, weighted with the area
/// around each node. NaN: no node is there, or the run has no springs.
[[nodiscard]] std::array<double, 4> tension_by_region(const Aggregate& aggregate);

}  // namespace spheroscope::statistics
