#pragma once

#include "engine/measures/measure_input.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solve/method.hpp"
#include "engine/stages/bead_packing.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spheroscope {

/// What acts on cells that were taken out of a larger run: the forces that hold them in the motion
/// that they had there, and the integrals of their volume controllers, which belong to the
/// pressures that they had.
struct HeldLoad {
    std::vector<Vec3> force_nN;             ///< [n_cells * n_nodes] constant in time
    std::vector<double> volume_integral_s;  ///< [n_cells] at the start
};

/// Cells that come from elsewhere (a frame of an earlier run).
struct GivenCells {
    std::vector<double> radius_um;  ///< [n_cells]
    std::vector<Vec3> x_um;         ///< [n_cells * n_nodes]
    int n_nodes = 0;
    std::optional<HeldLoad> held = {};  ///< for scenes with [load.held]
};

/// Radii of the scene's cells; for a packing they are drawn, for a given start they are the given
/// ones.
[[nodiscard]] std::vector<double> cell_radii(const scene::Scene& scene,
                                             const std::optional<GivenCells>& given);

/// Throws Error for cells of `arrangement = "centres"` that overlap by more than a radius: no
/// contact law can undo that.
void check_centres(const scene::Scene& scene);

/// Node positions at the start; for a packing all zero until the beads are replaced.
/// Throws Error when given cells are inside out, not finite, or do not fit the scene's mesh, or
/// when held forces are asked for that are not given.
[[nodiscard]] std::vector<Vec3> start_positions(const scene::Scene& scene, const Model& model,
                                                const std::optional<GivenCells>& given);

/// Puts a rest-shape cell at each centre, each turned by its own random rotation (seeded): with
/// equal orientations the meshes of neighbours would be aligned with each other.
void place_cells(const Model& model, std::span<const Vec3> centre_um, std::uint64_t seed,
                 std::span<Vec3> x_um);

/// The terms, frictions and contact law that the scene names. held_force_nN [all nodes] is what
/// [load.held] of the scene stands for; only a system whose forces nobody asks for can do without.
[[nodiscard]] SystemParts build_parts(const scene::Scene& scene,
                                      std::span<const Vec3> held_force_nN = {});

[[nodiscard]] MethodParameters method_parameters(const scene::Scene& scene);
[[nodiscard]] BeadPackingParameters packing_parameters(const scene::Stage& stage);

/// One line of `check --explain`: a part of the program, and why it is in the run or not.
struct PlanRow {
    std::string part;  ///< "cortex.bending", "contact search", "linear solver", a field ...
    std::string equation;
    bool is_in = false;
    std::string because;  ///< the scene line, or what is missing
};
/// Every part that a scene can have, in the order of a step. Throws Error for an unknown method or
/// field.
[[nodiscard]] std::vector<PlanRow> explain(const scene::Scene& scene);

}  // namespace spheroscope
