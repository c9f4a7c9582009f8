#include "render/range.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::render {

namespace {

// Bins of ratio 2^(1/32) (2.2 %) from 2^-40 to 2^40 of a stored unit. What is smaller lands in bin
// 0; no stress or tension of the model comes near the upper end.
constexpr int k_bins_per_octave = 32;
constexpr int k_lowest_octave = -40;
constexpr int k_highest_octave = 40;
constexpr int k_n_bins = k_bins_per_octave * (k_highest_octave - k_lowest_octave);

std::size_t bin_of(double size) {
    if (size <= 0.0) return 0;
    const double place = (std::log2(size) - k_lowest_octave) * k_bins_per_octave;
    return static_cast<std::size_t>(std::clamp(place, 0.0, k_n_bins - 1.0));
}

double upper_edge(std::size_t bin) {
    return std::exp2(k_lowest_octave + (static_cast<double>(bin) + 1.0) / k_bins_per_octave);
}

}  // namespace

RangeFinder::RangeFinder(const Field& field)
    : field_(field), positive_(k_n_bins, 0), negative_(k_n_bins, 0) {}

void RangeFinder::add(std::span<const float> stored) {
    for (const float value : stored) {
        if (std::isnan(value)) continue;
        ++n_values_;
        const double size = std::abs(static_cast<double>(value));
        ++(value < 0.0F ? negative_ : positive_)[bin_of(size)];
    }
}

double RangeFinder::reach(const std::vector<std::int64_t>& counts) const {
    const double allowed = k_share_beyond * static_cast<double>(n_values_);
    std::int64_t beyond = 0;
    for (std::size_t bin = counts.size(); bin-- > 0;) {
        beyond += counts[bin];
        if (static_cast<double>(beyond) > allowed) return upper_edge(bin);
    }
    return 0.0;
}

Range RangeFinder::range() const {
    const double scale = field_.shown_per_stored;
    const double smallest = k_smallest_half_width * scale;
    const double high = std::max(reach(positive_) * scale, smallest);
    const double low = reach(negative_) * scale;
    if (field_.range == RangeKind::signed_about_zero) {
        const double half_width = nice_ceil(std::max(high, low));
        return {-half_width, half_width};
    }
    // A 'magnitude' that is often negative (a tension under compression) is shown, not cut off.
    return {low > smallest ? -nice_ceil(low) : 0.0, nice_ceil(high)};
}

double RangeFinder::share_outside(const Range& range) const {
    if (n_values_ == 0) return 0.0;
    std::int64_t n_outside = 0;
    const auto count = [&](const std::vector<std::int64_t>& counts, double sign) {
        for (std::size_t bin = 0; bin < counts.size(); ++bin) {
            // A bin counts unless all of it is inside. 1e-6: values are float32.
            const double far = sign * upper_edge(bin) * field_.shown_per_stored;
            const double near =
                bin == 0 ? 0.0 : sign * upper_edge(bin - 1) * field_.shown_per_stored;
            const double slack = 1e-6 * (range.high - range.low);
            const bool inside = std::max(far, near) <= range.high + slack &&
                                std::min(far, near) >= range.low - slack;
            if (!inside) n_outside += counts[bin];
        }
    };
    count(positive_, +1.0);
    count(negative_, -1.0);
    return static_cast<double>(n_outside) / static_cast<double>(n_values_);
}

double nice_ceil(double x) {
    constexpr std::array<double, 11> steps{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    // 1e-9: a number that is already nice stays, in spite of the rounding of pow and log10
    for (const double step : steps)
        if (step * decade >= x * (1.0 - 1e-9)) return step * decade;
    return 10.0 * decade;
}

double nice_step(double x) {
    const double decade = std::pow(10.0, std::floor(std::log10(x) + 1e-9));
    const double lead = x / decade * (1.0 + 1e-9);
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * decade;
}

int digits_for(double value, double step, int fewest) {
    if (value == 0.0) return fewest;
    const auto power = [](double x) { return static_cast<int>(std::floor(std::log10(x) + 1e-9)); };
    return std::max(fewest, 1 + power(std::abs(value)) - power(step));
}

std::vector<double> ticks(const Range& range) {
    // The smallest round step that leaves at most four intervals inside the range.
    double step = nice_step((range.high - range.low) / 4.0);
    while ((range.high - range.low) / step > 6.0 + 1e-9) step = nice_step(step * 2.5);
    std::vector<double> values;
    const double first = std::ceil(range.low / step - 1e-9);
    for (double k = first; k * step <= range.high + 1e-9 * step; k += 1.0)
        values.push_back(k == 0.0 ? 0.0 : k * step);
    return values;
}

}  // namespace spheroscope::render
