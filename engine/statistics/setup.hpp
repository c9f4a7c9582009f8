#pragma once

#include "engine/run/changes.hpp"
#include "engine/run/snapshot.hpp"

#include <span>
#include <string>

namespace spheroscope::statistics {

/// What a run was of, without its seed: runs with the same `scene_without_seed` are replicates.
struct Setup {
    std::string scene_without_seed;  ///< the resolved scene's text, and the changes
    std::string scene_alone;         ///< the same without the changes
    std::string changes;             ///< changes_text of those on its way that cells feel, or ""
    std::string title;
    double gamma_over_omega = 0.0, Et_over_omega = 0.0;  ///< NaN without adhesion, or cortex
    double omega_nN_per_um = 0.0, E_kPa = 0.0;           ///< NaN likewise
    double W_nN_per_um = 0.0, gamma_nN_per_um = 0.0, thickness_um = 0.0;
    double limiter_nN_per_um = 0.0;  ///< kappa of the strain limiter; 0: it is off
    int n_cells = 0, n_nodes = 0;
    std::string law;            ///< "traction"
    std::string omega_reading;  ///< "text"

    /// Whether E and omega lie in the ranges of the paper's Table 2 (E 0.3125 ... 320 kPa, omega
    /// 0.0625 ... 1 nN/um).
    [[nodiscard]] bool is_in_table_2() const;
    /// The same for other ratios with this tension and thickness.
    [[nodiscard]] bool is_in_table_2(double other_gamma_over_omega,
                                     double other_Et_over_omega) const;
};

/// changes: what was changed while the run went on. The ratios are those of its beginning. Throws
/// Error when the run's scene cannot be read.
[[nodiscard]] Setup setup_of(const RunHeader& header, std::span<const Change> changes = {});

/// "1/8", "2", "0.3": powers of two below one as fractions, as the paper writes them.
[[nodiscard]] std::string ratio_text(double ratio);

}  // namespace spheroscope::statistics
