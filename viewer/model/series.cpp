#include "viewer/model/series.hpp"

#include "engine/base/error.hpp"
#include "engine/base/index.hpp"
#include "engine/statistics/contact_forces.hpp"
#include "engine/statistics/histogram.hpp"
#include "engine/statistics/radial_profile.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace spheroscope::viewer {
namespace {

constexpr double k_none = std::numeric_limits<double>::infinity();

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
    const std::vector<float>& values =
        snapshot.fields[static_cast<std::size_t>(row - header.fields.begin())];

    statistics::Aggregate aggregate;
    for (int c = 0; c < header.n_cells; ++c) {
        aggregate.centre_um.push_back(point(snapshot.centre_um, idx(c)));
        aggregate.volume_um3.push_back(double{snapshot.volume_um3[idx(c)]});
        aggregate.radius_um.push_back(double{header.radius_um[idx(c)]});
        aggregate.sigma_h_kPa.push_back(double{values[idx(c)]});
    }
    statistics::finish_aggregate(aggregate);
    // Which cell a probe is in would take too long for a picture, and beyond R_th alone it matters.
    statistics::Probes probes;
    for (const Vec3& at_um : statistics::random_points_um(aggregate, header.seed))
        if ((at_um - aggregate.middle_um).norm() <= aggregate.R_th_um)
            probes.at_um.push_back(at_um);
    const std::vector<std::vector<statistics::ProbeSample>> run{statistics::sample_cells(
        aggregate, probes, aggregate.sigma_h_kPa, statistics::Interpolation::nearest_cell)};
    Curve curve;
    for (const statistics::ProfilePoint& bin : statistics::pooled_profile(run)) {
        curve.x.push_back(static_cast<float>(bin.r));
        curve.y.push_back(static_cast<float>(bin.mean * (*row)->shown_per_stored));
    }
    return curve;
}

Curve force_distribution(const Snapshot& snapshot) {
    if (!has_mechanics(snapshot.stage_name)) return {};
    std::vector<PairForce> pairs;
    for (const ContactLink& link : snapshot.links)
        pairs.push_back({link.cell_a, link.cell_b, double{link.force_nN}, double{link.area_um2}});
    // Links are the contacts that touch: their area is above the scene's touching_area already.
    const statistics::ContactForces forces =
        statistics::contact_forces(pairs, 0.0, statistics::ForceNorm::all);
    if (forces.f.size() < 3 || !(forces.mean_nN > 0.0)) return {};
    const statistics::Histogram histogram = statistics::doane_histogram(forces.f);
    Curve curve;
    for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
        curve.x.push_back(static_cast<float>(histogram.middle(bin)));
        curve.y.push_back(static_cast<float>(histogram.density(bin)));
    }
    return curve;
}

}  // namespace spheroscope::viewer
