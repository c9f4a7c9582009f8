#include "viewer/model/series.hpp"

#include "engine/base/error.hpp"
#include "engine/base/index.hpp"
#include "engine/base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::viewer {
namespace {

constexpr double k_none = std::numeric_limits<double>::infinity();
constexpr std::size_t k_n_bins = 10;
constexpr int k_n_probes = 10000;

Vec3 point(const std::vector<float>& values, std::size_t i) {
    return {double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]}};
}

}  // namespace

FrameSummary summary_of(const Snapshot& snapshot) {
    return {snapshot.frame, snapshot.time_s, snapshot.stage_name, snapshot.totals,
            snapshot.diagnostics};
}

std::span<const SeriesRow> all_series() {
    using F = FrameSummary;
    static constexpr std::array<SeriesRow, 9> rows{{
        {Series::coordination, "Z", "", [](const F& f) { return f.totals.coordination_Z; }, k_none,
         -k_none, ""},
        {Series::volume_error, "volume error", "", [](const F& f) { return f.totals.volume_error; },
         0.01, -k_none, "a cell is more than 1 % away from its volume"},
        {Series::smallest_triangle, "smallest triangle", "of the mean",
         [](const F& f) { return f.totals.smallest_triangle; }, k_none, 0.1,
         "a triangle is nearly gone"},
        {Series::flipped_triangles, "flipped triangles", "",
         [](const F& f) { return static_cast<double>(f.totals.n_flipped_triangles); }, 0.0, -k_none,
         "a triangle faces inward"},
        {Series::folded_edges, "folded edges", "",
         [](const F& f) { return static_cast<double>(f.totals.n_folds); }, 0.0, -k_none,
         "an edge is folded over"},
        {Series::force_balance, "force balance", "nN",
         [](const F& f) {
             // The wall is no part of the aggregate: while it presses, the sum is its own.
             return f.diagnostics.wall_radius_um > 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                                       : f.diagnostics.force_balance_nN;
         },
         0.01, -k_none, "forces do not add up to nothing: a pull from outside, or an error"},
        {Series::residual_force, "residual force", "nN",
         [](const F& f) { return f.diagnostics.force_residual_nN; }, k_none, -k_none, ""},
        {Series::time_step, "time step", "s", [](const F& f) { return f.diagnostics.dt_s; }, k_none,
         -k_none, ""},
        {Series::iterations_per_step, "iterations per step", "",
         [](const F& f) {
             return f.diagnostics.steps == 0
                        ? std::numeric_limits<double>::quiet_NaN()
                        : static_cast<double>(f.diagnostics.linear_iterations) /
                              static_cast<double>(f.diagnostics.steps);
         },
         k_none, -k_none, ""},
    }};
    return rows;
}

const SeriesRow& row_of(Series series) {
    const SeriesRow& row = all_series()[static_cast<std::size_t>(series)];
    SPHEROSCOPE_ASSERT(row.series == series, "rows are in the order of the enumeration");
    return row;
}

bool is_bad(const SeriesRow& row, double value) {
    return value > row.largest || value < row.smallest;
}

std::vector<int> bad_frames(const SeriesRow& row, std::span<const FrameSummary> run) {
    std::vector<int> bad;
    for (const FrameSummary& frame : run)
        if (is_bad(row, row.value(frame))) bad.push_back(frame.frame);
    return bad;
}

Curve radial_stress(const Snapshot& snapshot) {
    const RunHeader& header = *snapshot.header;
    const auto row = std::find_if(header.fields.begin(), header.fields.end(),
                                  [](const Field* field) { return field->name == "sigma_h"; });
    if (row == header.fields.end() || snapshot.links.empty() || !has_mechanics(snapshot.stage_name))
        return {};
    const Field& field = **row;
    const std::vector<float>& values =
        snapshot.fields[static_cast<std::size_t>(row - header.fields.begin())];

    Vec3 middle = Vec3::Zero();
    double volume_um3 = 0.0;
    for (int c = 0; c < header.n_cells; ++c) {
        middle += double{snapshot.volume_um3[idx(c)]} * point(snapshot.centre_um, idx(c));
        volume_um3 += double{snapshot.volume_um3[idx(c)]};
    }
    middle /= volume_um3;
    const double R_th_um = std::cbrt(3.0 * volume_um3 / (4.0 * std::numbers::pi));

    std::array<double, k_n_bins> sum{};
    std::array<int, k_n_bins> count{};
    const Random random(1, static_cast<std::uint32_t>(RandomStream::probe));
    for (int probe = 0; probe < k_n_probes; ++probe) {
        const auto at = static_cast<std::uint64_t>(probe);
        const double r = std::cbrt(random.uniform(at, 0));  // in R_th; uniform in the ball
        const double cosine = 2.0 * random.uniform(at, 1) - 1.0;
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double turn = 2.0 * std::numbers::pi * random.uniform(at, 2);
        const Vec3 x =
            middle + r * R_th_um * Vec3(sine * std::cos(turn), sine * std::sin(turn), cosine);
        int nearest = 0;
        double distance2 = k_none;
        for (int c = 0; c < header.n_cells; ++c) {
            const double d2 = (point(snapshot.centre_um, idx(c)) - x).squaredNorm();
            if (d2 < distance2) {
                distance2 = d2;
                nearest = c;
            }
        }
        const auto bin = std::min(static_cast<std::size_t>(r * k_n_bins), k_n_bins - 1);
        sum[bin] += double{values[idx(nearest)]} * field.shown_per_stored;
        ++count[bin];
    }
    Curve curve;
    for (std::size_t bin = 0; bin < k_n_bins; ++bin) {
        if (count[bin] == 0) continue;
        curve.x.push_back((static_cast<float>(bin) + 0.5F) / k_n_bins);
        curve.y.push_back(static_cast<float>(sum[bin] / count[bin]));
    }
    return curve;
}

Curve force_distribution(const Snapshot& snapshot) {
    if (!has_mechanics(snapshot.stage_name)) return {};
    std::vector<double> f;
    double sum = 0.0;
    for (const ContactLink& link : snapshot.links)
        if (link.force_nN > 0.0F) {
            f.push_back(double{link.force_nN});
            sum += f.back();
        }
    if (f.size() < 3) return {};
    const double n = static_cast<double>(f.size());
    double m2 = 0.0, m3 = 0.0, largest = 0.0;
    for (double& value : f) {
        value /= sum / n;
        m2 += (value - 1.0) * (value - 1.0) / n;
        m3 += (value - 1.0) * (value - 1.0) * (value - 1.0) / n;
        largest = std::max(largest, value);
    }
    const double skewness = m2 > 0.0 ? m3 / (m2 * std::sqrt(m2)) : 0.0;
    const double spread = std::sqrt(6.0 * (n - 2.0) / ((n + 1.0) * (n + 3.0)));
    const double bins = 1.0 + std::log2(n) + std::log2(1.0 + std::abs(skewness) / spread);
    const auto n_bins = static_cast<std::size_t>(std::ceil(bins));
    const double width = largest / static_cast<double>(n_bins);
    Curve curve;
    for (std::size_t bin = 0; bin < n_bins; ++bin) {
        curve.x.push_back(static_cast<float>((static_cast<double>(bin) + 0.5) * width));
        curve.y.push_back(0.0F);
    }
    for (const double value : f)
        curve.y[std::min(static_cast<std::size_t>(value / width), n_bins - 1)] +=
            static_cast<float>(1.0 / (n * width));
    return curve;
}

}  // namespace spheroscope::viewer
