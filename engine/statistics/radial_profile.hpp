#pragma once

#include "engine/statistics/probes.hpp"

#include <span>
#include <vector>

namespace spheroscope::statistics {

/// Bins of r / R_th, from zero to k_probe_reach.
inline constexpr double k_bin_width = 0.05;
/// A bin with fewer probes in all replicates together is left out.
inline constexpr int k_least_probes = 10;

/// One bin of a profile.
struct ProfilePoint {
    double r;               ///< middle of the bin, over R_th
    double mean;            ///< over all probes of all replicates
    double spread;          ///< standard deviation over the same probes
    double standard_error;  ///< of the replicates' own means of this bin; NaN below two replicates
    int n_probes;
    int n_replicates;  ///< those with a probe in this bin
};

/// The probes of all replicates together, bin by bin, ascending. NaN values ('nothing to measure')
/// are left out.
[[nodiscard]] std::vector<ProfilePoint>
pooled_profile(std::span<const std::vector<ProbeSample>> replicates);

/// Where a profile passes from below zero to above it for the last time going outward, over R_th,
/// by straight lines between bins; NaN: nowhere. Farther in, where bins hold few cells, noise
/// crosses zero as well.
[[nodiscard]] double zero_crossing(std::span<const ProfilePoint> profile);
/// Where it is largest outside of that crossing, or anywhere if there is none, over R_th; NaN for
/// an empty one.
[[nodiscard]] double peak(std::span<const ProfilePoint> profile);

}  // namespace spheroscope::statistics
