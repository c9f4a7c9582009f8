#pragma once

#include "engine/reports/plot.hpp"
#include "engine/reports/report_table.hpp"
#include "engine/statistics/run_statistics.hpp"
#include "engine/statistics/seed_mean.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

// The figures of Cuvelier et al. 2021 as plots and numbers, from the statistics of stored runs.
// Nothing here draws or knows of files.
namespace spheroscope::figures {

using Setups = std::span<const statistics::SetupStatistics>;

/// One figure: panels for those who look, and each drawn number once more in the table.
struct Figure {
    reports::Plot plot;  ///< no panels: it cannot be drawn, and `missing` says why
    reports::ReportTable table;
    std::vector<std::string> missing;  ///< what could not be drawn, of which run, and why
};

/// What a reader of any figure has to know about the runs behind it: in what setups differ that
/// have the same label, runs that have not ended, ended at their cap or move faster than at rest,
/// setups with fewer seeds than others, runs of several versions.
[[nodiscard]] std::vector<std::string> remarks_on_runs(Setups setups);

/// One row of the table of figures.
struct FigureRow {
    std::string_view name;   ///< of its files: "fig2"
    std::string_view title;  ///< what it shows
    Figure (*make)(Setups);
};
[[nodiscard]] std::span<const FigureRow> all_figures();

// One file each.
[[nodiscard]] Figure radial_profiles(Setups setups);
[[nodiscard]] Figure stress_profiles(Setups setups);
[[nodiscard]] Figure stress_statistics(Setups setups);
[[nodiscard]] Figure contact_network(Setups setups);
[[nodiscard]] Figure force_displacement(Setups setups);
[[nodiscard]] Figure parameter_maps(Setups setups);

}  // namespace spheroscope::figures
