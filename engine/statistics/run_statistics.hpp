#pragma once

#include "engine/statistics/bulk_modulus.hpp"
#include "engine/statistics/cell_stress.hpp"
#include "engine/statistics/contact_forces.hpp"
#include "engine/statistics/coordination.hpp"
#include "engine/statistics/probes.hpp"
#include "engine/statistics/setup.hpp"
#include "engine/statistics/stress_at_pores.hpp"
#include "engine/statistics/tension_by_region.hpp"

#include <array>
#include <string>
#include <vector>

namespace spheroscope::statistics {

/// One frame of a stage that presses with a bead.
struct LoadPoint {
    double time_s, way_um, probe_nN, hull_nN, imbalance;
};

/// The state in which one run ended: everything that the figures need of one seed.
struct RunStatistics {
    std::string file;
    std::uint64_t seed = 0;
    std::string version;
    std::string outcome;     ///< "" while the run goes on
    std::string stage_name;  ///< of the frame
    double time_s = 0.0;
    double last_dt_s = 0.0;  ///< the last accepted step before the frame
    Setup setup;
    Totals totals{};
    double R_th_um = 0.0;

    // Probes, by distance from the middle over R_th.
    std::vector<ProbeSample> sigma_h_nearest_kPa, sigma_h_smooth_kPa;
    std::vector<ProbeSample> voids;
    std::array<std::vector<ProbeSample>, 4> cell_stress_kPa;  ///< rows of all_cell_stresses()

    std::array<double, 4> tension_nN_per_um{};  ///< in k_regions
    StressAtPores sigma_nn{};
    std::vector<CellStress> equal_kPa, area_kPa;  ///< [cells] both weightings
    std::vector<char> is_core;                    ///< [cells] not in the rim layer
    std::vector<PairForce> pairs;
    double touching_area_um2 = 0.1;
    // Frame by frame; whoever reads the file fills it in.
    std::vector<LoadPoint> load;
    /// Frames under the bead whose force or way is undefined: they are not in `load`.
    int n_undefined_loads = 0;
    std::vector<WallPoint> wall;
    double extent_um = 0.0;  ///< distance of the farthest node from the middle

    /// Whether its last stage came to its end, at rest or at its cap.
    [[nodiscard]] bool has_ended() const;
    [[nodiscard]] double coordination_at(double threshold_um2) const;
    /// Mean over the cells of one number of their stress, kPa; NaN where no cell touches another.
    [[nodiscard]] double mean_stress_kPa(const CellStressRow& row, Weighting weighting) const;
    /// The same over the core cells, or over all others, with equal weights.
    [[nodiscard]] double mean_stress_of_layer_kPa(const CellStressRow& row, bool of_core) const;
};

/// Measures one frame of a run, with what was changed on its way: some tenths of a second; `file`,
/// `outcome`, `load` and `wall` are left empty. Throws Error when there is no mechanics in it (no
/// contacts in the scene, beads that are being packed), or it cannot be evaluated.
[[nodiscard]] RunStatistics measure_run(const SnapshotPtr& frame,
                                        std::span<const Change> changes = {});

/// Replicates: runs of one setup, ascending by seed.
struct SetupStatistics {
    std::string label;   ///< what tells it from the others
    std::string family;  ///< the same without Et/omega: setups of one line of a plot over it
    /// Of setups that only a number in brackets tells apart: the label without it. Else "".
    std::string shared_label;
    std::vector<RunStatistics> runs;

    [[nodiscard]] const Setup& setup() const { return runs.front().setup; }
};

/// Puts runs of the same setup together, in the order of gamma/omega, Et/omega and N, and labels
/// them by what differs between them. Throws Error when a seed is there twice in a setup.
[[nodiscard]] std::vector<SetupStatistics> group_by_setup(std::vector<RunStatistics> runs);

}  // namespace spheroscope::statistics
