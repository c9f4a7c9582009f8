#pragma once

#include <span>
#include <string_view>

namespace spheroscope {

/// What is known about a force term without making one: for documentation, `check --explain` and
/// tests that loop over all terms.
struct ForceTermRow {
    std::string_view name;      ///< ForceTerm::name(); begins with its table in the scene
    std::string_view equation;  ///< of Cuvelier et al. 2021; empty: not in the paper
    std::string_view file;
    std::string_view effect;
    bool internal;      ///< its forces on a cell have no sum and no torque
    bool zero_at_rest;  ///< no force on a cell in its rest shape
    /// F = -dE/dx holds for each configuration; false: E also changes by itself in time (the volume
    /// controller's integral, the moving wall), so that it is no part of a falling energy.
    bool energy_is_state_function;
};

/// All terms of single cells, in the order in which a step evaluates them.
[[nodiscard]] std::span<const ForceTermRow> force_terms();

}  // namespace spheroscope
