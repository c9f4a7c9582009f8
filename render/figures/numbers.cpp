#include "engine/statistics/tail_exponent.hpp"
#include "engine/statistics/void_fraction.hpp"
#include "render/figures/parts.hpp"

#include <cmath>

namespace spheroscope::figures {
namespace {

using statistics::RunStatistics;
using statistics::SetupStatistics;
using statistics::Weighting;

/// Depth below R_th at which sigma_h of one run changes its sign, or is largest.
double depth_um(const RunStatistics& run,
                double (*place)(std::span<const statistics::ProfilePoint>)) {
    const std::vector<std::vector<statistics::ProbeSample>> one{run.sigma_h_nearest_kPa};
    return (1.0 - place(statistics::pooled_profile(one))) * run.R_th_um;
}

void add_totals(const SetupStatistics& setup, std::vector<SetupNumber>& numbers) {
    for (const TotalsRow& row : all_totals())
        numbers.push_back({std::string(row.name), std::string(row.unit),
                           over_seeds(setup, [&](const RunStatistics& run) {
                               return value_of(row, run.totals);
                           })});
}

void add_stresses(const SetupStatistics& setup, std::vector<SetupNumber>& numbers) {
    for (const statistics::CellStressRow& row : statistics::all_cell_stresses())
        for (const auto weighting : {Weighting::equal, Weighting::area})
            numbers.push_back(
                {std::string(row.quantity) + (weighting == Weighting::area ? "_by_area" : ""), "Pa",
                 over_seeds(setup, [&](const RunStatistics& run) {
                     return k_Pa_per_kPa * run.mean_stress_kPa(row, weighting);
                 })});
}

void add_forces(const SetupStatistics& setup, std::vector<SetupNumber>& numbers) {
    const auto forces = [](const RunStatistics& run) {
        return statistics::contact_forces(run.pairs, run.touching_area_um2,
                                          statistics::ForceNorm::all);
    };
    numbers.push_back({"mean_contact_force", "nN", over_seeds(setup, [&](const RunStatistics& run) {
                           return forces(run).mean_nN;
                       })});
    numbers.push_back({"tensile_share", "1", over_seeds(setup, [&](const RunStatistics& run) {
                           return forces(run).tensile_share;
                       })});
}

}  // namespace

std::vector<SetupNumber> numbers_of(const SetupStatistics& setup) {
    std::vector<SetupNumber> numbers;
    add_totals(setup, numbers);
    numbers.push_back({"sigma_h_zero_depth", "um", over_seeds(setup, [](const RunStatistics& run) {
                           return depth_um(run, statistics::zero_crossing);
                       })});
    numbers.push_back({"sigma_h_peak_depth", "um", over_seeds(setup, [](const RunStatistics& run) {
                           return depth_um(run, statistics::peak);
                       })});
    numbers.push_back({"void_fraction", "1", over_seeds(setup, [](const RunStatistics& run) {
                           return statistics::void_fraction(run.voids, 0.5);
                       })});
    for (std::size_t r = 0; r < statistics::k_regions.size(); ++r)
        numbers.push_back({"gamma_eff, " + std::string(name_of(statistics::k_regions[r])), "mN/m",
                           over_seeds(setup, [&](const RunStatistics& run) {
                               return run.tension_nN_per_um[r];
                           })});
    add_stresses(setup, numbers);
    add_forces(setup, numbers);
    return numbers;
}

}  // namespace spheroscope::figures
