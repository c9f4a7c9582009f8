#pragma once

#include "engine/statistics/radial_profile.hpp"
#include "engine/statistics/setup_numbers.hpp"
#include "render/figures/figure.hpp"

// What the figures have in common.
namespace spheroscope::figures {

inline constexpr double k_Pa_per_kPa = 1000.0;

/// Where a number of a figure's table stands.
struct Place {
    std::string panel;     ///< "a"
    std::string quantity;  ///< "sigma_h"
    std::string unit;
    std::string x_name;  ///< "" where there is no abscissa
    std::string x;
};
/// The columns that all figures' tables have.
[[nodiscard]] reports::ReportTable empty_table();
/// Adds one number. `n`: probes, cells or forces behind it; 0: does not apply.
void add_row(reports::ReportTable& table, const statistics::SetupStatistics& setup,
             const Place& place, const statistics::Estimate& value, double spread, int n);

/// A profile of all setups as a panel: means of the pooled probes over r / R_th, with the standard
/// error over seeds. `samples` gives a run's probes; values are multiplied by `scale`.
using SamplesOf = const std::vector<statistics::ProbeSample>& (*)(const statistics::RunStatistics&,
                                                                  std::size_t);
void add_profile_panel(Figure& figure, Setups setups, const Place& place, const std::string& title,
                       const std::string& y_title, double scale, SamplesOf samples,
                       std::size_t number = 0);

/// What the points of a panel over Et/omega are joined to: those of one family to a line, or
/// none, where each setup has a name of its own in the other panels.
enum class Joined { families, none };
/// A number of each setup over Et/omega as a panel.
using EstimateOf = std::function<statistics::Estimate(const statistics::SetupStatistics&)>;
void add_ratio_panel(Figure& figure, Setups setups, const Place& place, const std::string& title,
                     const std::string& y_title, Joined joined, const EstimateOf& estimate);

/// Experimental ranges of the stress of cells, Pa, by row of all_cell_stresses(); empty where
/// there is none.
[[nodiscard]] std::vector<reports::Plot::Band> experimental_bands(std::size_t row);
/// "mean normal stress (Pa)"
[[nodiscard]] std::string stress_title(std::size_t row);

/// What is the same in all captions.
void finish(Figure& figure, Setups setups, const std::string& title);

}  // namespace spheroscope::figures
