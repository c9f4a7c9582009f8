#pragma once

#include "engine/statistics/histogram.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace spheroscope::statistics {

/// P(f) = a exp(-b f^beta) where f > 1.
struct TailFit {
    double beta = 0.0;
    double a = 0.0, b = 1.0;
    double beta_error = 0.0;   ///< of the bootstrap's samples; NaN where too few have a fit
    int n_forces = 0;          ///< that lie above 1
    int n_bins = 0;            ///< that the fit saw
    int n_samples = 0;         ///< of the bootstrap
    int n_failed_samples = 0;  ///< of those, without a fit
    std::string reason = {};   ///< why there is no fit; then the numbers mean nothing
    [[nodiscard]] bool exists() const { return reason.empty(); }
    /// Why there is no fit, or none of its error; "" if there are both.
    [[nodiscard]] std::string gap() const;
};

enum class TailScale {
    one,   ///< b = 1
    free,  ///< b is fitted as well
};

/// Below this many forces above 1 there is no fit.
inline constexpr int k_least_forces = 30;
/// Above this share of failed samples there is no error.
inline constexpr double k_most_failed = 0.1;

/// The most likely beta (between 0.1 and 6) for the counts in those bins of Doane's histogram of f
/// that begin at or above f = 1. Least squares of ln P cannot use empty bins, and finds 0.96 where
/// 750 forces have beta = 1; the likelihood finds 1.00.
///
/// With f = F / <F> and b = 1 this is the exponent of a law of given scale: forces whose law falls
/// as a Gaussian, P ~ exp(-f^2 / pi), have beta = 1.2 in it, and 2 with b free.
///
/// There is no fit where the likelihood still grows at a bound of beta. The error is that of
/// n_samples bootstrap samples of the forces, drawn with replacement from `seed`, each with its own
/// bins; undefined where more than k_most_failed of them have no fit: the others are those that lie
/// well.
[[nodiscard]] TailFit fit_tail(std::span<const double> f, TailScale scale, std::uint64_t seed = 1,
                               int n_samples = 200);

}  // namespace spheroscope::statistics
