#include "engine/statistics/tail_exponent.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace spheroscope::statistics {
namespace {

constexpr double k_beta_low = 0.1, k_beta_high = 6.0;
/// The search comes to within 1e-5 of a bound at which the likelihood still grows.
constexpr double k_at_bound = 1e-4;

/// A bin of the tail.
struct Point {
    double f;
    double count;
};

struct Tail {
    std::vector<Point> points;
    int n_filled = 0;
};

Tail tail_of(const Histogram& histogram) {
    Tail tail;
    for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
        const double low = histogram.low + static_cast<double>(bin) * histogram.width;
        if (low < 1.0) continue;
        tail.points.push_back({histogram.middle(bin), static_cast<double>(histogram.counts[bin])});
        if (histogram.counts[bin] > 0) ++tail.n_filled;
    }
    return tail;
}

/// Where a function of one variable is smallest: a coarse look at the whole interval, then golden
/// section around the best.
template <class F> double argmin(double low, double high, int n_coarse, const F& function) {
    const double step = (high - low) / (n_coarse - 1);
    double best = low, smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_coarse; ++i) {
        const double value = function(low + i * step);
        if (value < smallest) {
            smallest = value;
            best = low + i * step;
        }
    }
    double a = std::max(low, best - step), b = std::min(high, best + step);
    for (int i = 0; i < 25; ++i) {
        const double left = b - (b - a) / std::numbers::phi;
        const double right = a + (b - a) / std::numbers::phi;
        if (function(left) < function(right))
            b = right;
        else
            a = left;
    }
    return 0.5 * (a + b);
}

/// Minus the logarithm of the probability that forces of the tail fall into its bins like this.
double surprise(const Tail& tail, std::span<const double> powers, double b) {
    double counts = 0.0, sum = 0.0, logs = 0.0;
    for (std::size_t i = 0; i < tail.points.size(); ++i) {
        const double exponent = b * (powers[i] - powers[0]);
        sum += std::exp(-exponent);
        logs -= tail.points[i].count * exponent;
        counts += tail.points[i].count;
    }
    return counts * std::log(sum) - logs;
}

/// The best b for one beta, and how surprising the counts then are.
struct Scale {
    double b, surprise;
};
Scale best_scale(const Tail& tail, double beta, TailScale scale) {
    std::vector<double> powers;
    for (const Point& point : tail.points) powers.push_back(std::pow(point.f, beta));
    double b = 1.0;
    if (scale == TailScale::free)
        b = std::exp(argmin(std::log(1e-4), std::log(50.0), 20,
                            [&](double ln_b) { return surprise(tail, powers, std::exp(ln_b)); }));
    return {b, surprise(tail, powers, b)};
}

double best_beta(const Tail& tail, TailScale scale) {
    return argmin(k_beta_low, k_beta_high, 30,
                  [&](double beta) { return best_scale(tail, beta, scale).surprise; });
}

bool ends_at_bound(double beta) {
    return beta < k_beta_low + k_at_bound || beta > k_beta_high - k_at_bound;
}

int bins_needed(TailScale scale) { return scale == TailScale::free ? 4 : 3; }

std::optional<double> beta_of(std::span<const double> f, TailScale scale) {
    const Tail tail = tail_of(doane_histogram(f));
    if (tail.n_filled < bins_needed(scale)) return {};
    const double beta = best_beta(tail, scale);
    if (ends_at_bound(beta)) return {};
    return beta;
}

/// Standard deviation of beta over samples of the forces, drawn with replacement.
void add_bootstrap(std::span<const double> f, TailScale scale, std::uint64_t seed, int n_samples,
                   TailFit& fit) {
    const Random random(seed, static_cast<std::uint32_t>(RandomStream::bootstrap));
    double sum = 0.0, square = 0.0;
    int n = 0;
    std::vector<double> sample(f.size());
    for (int s = 0; s < n_samples; ++s) {
        for (std::size_t i = 0; i < f.size(); ++i) {
            const double u = random.uniform(static_cast<std::uint64_t>(s) * f.size() + i);
            const auto chosen = static_cast<std::size_t>(u * static_cast<double>(f.size()));
            sample[i] = f[std::min(chosen, f.size() - 1)];
        }
        if (const auto beta = beta_of(sample, scale)) {
            sum += *beta;
            square += *beta * *beta;
            ++n;
        }
    }
    fit.n_samples = n_samples;
    fit.n_failed_samples = n_samples - n;
    const bool is_known = n > 1 && fit.n_failed_samples <= k_most_failed * n_samples;
    fit.beta_error = is_known ? std::sqrt(std::max(0.0, (square - sum * sum / n) / (n - 1)))
                              : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string TailFit::gap() const {
    if (!exists() || !std::isnan(beta_error)) return reason;
    return fmt::format("no error, {} of {} have no fit", n_failed_samples,
                       counted(n_samples, "bootstrap sample"));
}

TailFit fit_tail(std::span<const double> f, TailScale scale, std::uint64_t seed, int n_samples) {
    TailFit fit;
    fit.n_forces =
        static_cast<int>(std::count_if(f.begin(), f.end(), [](double x) { return x > 1.0; }));
    if (fit.n_forces < k_least_forces) {
        fit.reason = "only " + std::to_string(fit.n_forces) +
                     " forces lie above the mean, a fit wants " + std::to_string(k_least_forces);
        return fit;
    }
    const Histogram histogram = doane_histogram(f);
    const Tail tail = tail_of(histogram);
    fit.n_bins = tail.n_filled;
    if (fit.n_bins < bins_needed(scale)) {
        fit.reason = "only " + std::to_string(fit.n_bins) +
                     " bins with a force lie above f = 1, a fit wants " +
                     std::to_string(bins_needed(scale));
        return fit;
    }
    fit.beta = best_beta(tail, scale);
    if (ends_at_bound(fit.beta)) {
        fit.reason = fmt::format("beta ends at its bound, {:.3g}", fit.beta);
        return fit;
    }
    fit.b = best_scale(tail, fit.beta, scale).b;
    double count = 0.0, sum = 0.0;
    for (const Point& point : tail.points) {
        count += point.count;
        sum += std::exp(-fit.b * std::pow(point.f, fit.beta));
    }
    fit.a = count / (histogram.n * histogram.width * sum);

    add_bootstrap(f, scale, seed, n_samples, fit);
    return fit;
}

}  // namespace spheroscope::statistics
