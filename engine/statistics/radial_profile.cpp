#include "engine/statistics/radial_profile.hpp"

#include "engine/statistics/seed_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope::statistics {

std::vector<ProfilePoint> pooled_profile(std::span<const std::vector<ProbeSample>> replicates) {
    const auto n_bins = static_cast<std::size_t>(std::lround(k_probe_reach / k_bin_width));
    struct Sum {
        double value = 0.0, square = 0.0;
        int n = 0;
        void add(double v) {
            value += v;
            square += v * v;
            ++n;
        }
    };
    std::vector<Sum> pooled(n_bins);
    std::vector<std::vector<double>> means(n_bins);  // of each replicate
    for (const std::vector<ProbeSample>& replicate : replicates) {
        std::vector<Sum> own(n_bins);
        for (const ProbeSample& sample : replicate) {
            const auto bin = static_cast<std::size_t>(sample.r / k_bin_width);
            if (bin >= n_bins || std::isnan(sample.value)) continue;
            own[bin].add(sample.value);
            pooled[bin].add(sample.value);
        }
        for (std::size_t b = 0; b < n_bins; ++b)
            if (own[b].n > 0) means[b].push_back(own[b].value / own[b].n);
    }
    std::vector<ProfilePoint> points;
    for (std::size_t b = 0; b < n_bins; ++b) {
        const Sum& sum = pooled[b];
        if (sum.n < k_least_probes) continue;
        const double mean = sum.value / sum.n;
        points.push_back({(static_cast<double>(b) + 0.5) * k_bin_width, mean,
                          std::sqrt(std::max(0.0, sum.square / sum.n - mean * mean)),
                          mean_over_seeds(means[b]).standard_error, sum.n,
                          static_cast<int>(means[b].size())});
    }
    return points;
}

double zero_crossing(std::span<const ProfilePoint> profile) {
    for (std::size_t i = profile.size(); i-- > 1;) {
        const ProfilePoint &a = profile[i - 1], &b = profile[i];
        if (a.mean < 0.0 && b.mean >= 0.0) return a.r + (b.r - a.r) * (-a.mean) / (b.mean - a.mean);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double peak(std::span<const ProfilePoint> profile) {
    const double from = zero_crossing(profile);
    double r = std::numeric_limits<double>::quiet_NaN();
    double largest = -std::numeric_limits<double>::infinity();
    for (const ProfilePoint& point : profile)
        if (!(point.r < from) && point.mean > largest) {
            largest = point.mean;
            r = point.r;
        }
    return r;
}

}  // namespace spheroscope::statistics
