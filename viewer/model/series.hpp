#pragma once

#include "engine/run/snapshot.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::viewer {

/// What is kept of a frame for plots over time, when its arrays are gone.
struct FrameSummary {
    int frame = 0;
    double time_s = 0.0;
    std::string stage_name;
    Totals totals{};
    Diagnostics diagnostics;
};
[[nodiscard]] FrameSummary summary_of(const Snapshot& snapshot);

/// Beads that are being seeded touch, but nothing about them is mechanics yet.
[[nodiscard]] inline bool has_mechanics(std::string_view stage_name) {
    return stage_name != "anneal";
}

/// What is followed over time, in the order of the table of its rows.
enum class Series {
    coordination,
    volume_error,
    smallest_triangle,
    flipped_triangles,
    folded_edges,
    force_balance,
    residual_force,
    time_step,
    iterations_per_step,
};

/// A number of the whole aggregate over time: a row of the table of plots, and of the health strip
/// where it has a limit.
struct SeriesRow {
    Series series;
    std::string_view name, unit;
    double (*value)(const FrameSummary&);  ///< in `unit`; NaN: undefined
    double largest, smallest;              ///< healthy between these; infinite: no limit
    std::string_view meaning;              ///< why a value beyond is bad; "" without limits
};
[[nodiscard]] std::span<const SeriesRow> all_series();
[[nodiscard]] const SeriesRow& row_of(Series series);

/// Whether a value is beyond the row's limits. Undefined values are not.
[[nodiscard]] bool is_bad(const SeriesRow& row, double value);
/// Indices of the frames that are.
[[nodiscard]] std::vector<int> bad_frames(const SeriesRow& row, std::span<const FrameSummary> run);

/// Points of a curve or bars of a histogram.
struct Curve {
    std::vector<float> x, y;
};

/// sigma_h over the distance from the middle of the aggregate in R_th, Pa: the profile of figures
/// (engine/statistics, values of the nearest cell) of this frame, as far as R_th. Empty without
/// contacts, and while beads are being seeded.
[[nodiscard]] Curve radial_stress(const Snapshot& snapshot);

/// Distribution of f = |F| / <|F|> over the contacts, as a density in Doane's bins, as figures have
/// it. Empty with fewer than three contacts, and while beads are being seeded.
[[nodiscard]] Curve force_distribution(const Snapshot& snapshot);

}  // namespace spheroscope::viewer
