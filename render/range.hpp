#pragma once

#include "engine/measures/fields.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope::render {

/// What the colours of a bar span, in the field's shown unit. low < high.
struct Range {
    double low = 0.0, high = 1.0;
    bool operator==(const Range&) const = default;
};

/// Finds the range that suits many values of one field, without keeping them: symmetric about zero
/// for a signed field, from zero for a magnitude, ends rounded outward to nice numbers, at most
/// half a percent of the values beyond either end.
///
/// A range never gets narrower than k_smallest_half_width of the engine's units (1 Pa, 1 uN/m):
/// rounding noise about zero must not fill the picture with colours.
class RangeFinder {
  public:
    static constexpr double k_smallest_half_width = 1e-3;  ///< stored units
    static constexpr double k_share_beyond = 0.005;        ///< of the values, at each end

    explicit RangeFinder(const Field& field);

    /// Counts stored values; NaN ('nothing to measure') is left out.
    void add(std::span<const float> stored);
    [[nodiscard]] std::int64_t n_values() const { return n_values_; }
    /// The range of all values so far; the smallest range if there was none.
    [[nodiscard]] Range range() const;
    /// An upper bound of the share of the values that lie outside a range (shown unit); 0 without
    /// values.
    [[nodiscard]] double share_outside(const Range& range) const;

  private:
    /// The smallest bin edge with at most k_share_beyond of all values above it, stored unit.
    [[nodiscard]] double reach(const std::vector<std::int64_t>& counts) const;

    const Field& field_;
    // Histograms of the size of positive and of negative values, in bins of equal ratio.
    std::vector<std::int64_t> positive_, negative_;
    std::int64_t n_values_ = 0;
};

/// The next number at or above x > 0 of the form {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8} * 10^n.
[[nodiscard]] double nice_ceil(double x);
/// The next number at or below x > 0 of the form {1, 2, 5} * 10^n: lengths of bars and steps of
/// ticks.
[[nodiscard]] double nice_step(double x);

/// Digits with which values of that size are told apart that lie `step` from each other, at least
/// `fewest`.
[[nodiscard]] int digits_for(double value, double step, int fewest);

/// Positions of 3 to 7 round tick values inside a range, ascending.
[[nodiscard]] std::vector<double> ticks(const Range& range);

}  // namespace spheroscope::render
