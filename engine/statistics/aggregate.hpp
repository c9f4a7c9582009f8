#pragma once

#include "engine/base/vec3.hpp"
#include "engine/inspect/frame_system.hpp"
#include "engine/measures/pair_forces.hpp"
#include "engine/model/mesh_topology.hpp"

#include <memory>
#include <vector>

namespace spheroscope::statistics {

/// One frame of a run as plain numbers: all that the statistics read. Arrays run cell by cell, as
/// in the run's file.
struct Aggregate {
    std::shared_ptr<const MeshTopology> topology;
    std::vector<Vec3> x_um;                        ///< [all nodes]
    std::vector<Vec3> centre_um;                   ///< [cells] mean of the nodes
    std::vector<double> radius_um;                 ///< [cells] rest radius
    std::vector<double> volume_um3;                ///< [cells]
    std::vector<double> sigma_h_kPa;               ///< [cells] eqn (4)
    std::vector<double> anisotropic_max_kPa;       ///< [cells] P95 - P5 of sigma_nn
    std::vector<double> anisotropic_mean_kPa;      ///< [cells] standard deviation of sigma_nn
    std::vector<double> triangle_area_um2;         ///< [all triangles]
    std::vector<double> sigma_nn_kPa;              ///< [all triangles] NaN: no contact
    std::vector<double> shear_kPa;                 ///< [all triangles] NaN: no contact
    std::vector<double> gamma_eff_nN_per_um = {};  ///< [all nodes] empty: no springs
    std::vector<PairForce> pairs = {};             ///< with any contact area at all
    double touching_area_um2 = 0.1;                ///< the scene's

    // What follows from the above (finish_aggregate).
    Vec3 middle_um = Vec3::Zero();  ///< centres, weighted with volumes
    double R_th_um = 0.0;           ///< radius of the sphere with the volume of all cells
    double mean_radius_um = 0.0;

    [[nodiscard]] int n_cells() const { return static_cast<int>(centre_um.size()); }
    [[nodiscard]] double distance_um(int cell) const;  ///< from the middle
    /// Two mean radii below the surface of the equivalent sphere, as Totals has it.
    [[nodiscard]] bool is_core(int cell) const {
        return distance_um(cell) < R_th_um - 2.0 * mean_radius_um;
    }
};

/// Fills middle, R_th and mean radius from centres, volumes and radii.
void finish_aggregate(Aggregate& aggregate);

/// The frame that is loaded there, measured by the functions of engine/measures on the mesh that it
/// was computed on. So it does not matter which fields the run's scene asked for, and contacts
/// below the touching threshold are there too.
[[nodiscard]] Aggregate aggregate_of(const inspect::FrameSystem& frame);

}  // namespace spheroscope::statistics
