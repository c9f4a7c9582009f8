#include "engine/stages/relaxation.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

constexpr double k_virial_defect = 0.01;
constexpr double k_no_stress = 1e-4;  // of the cells' own pressure: 0.01 Pa
constexpr double k_window_s = 5.0;
constexpr double k_change = 0.005;
constexpr std::size_t k_row = 4;  // time, core sigma_h, Z, contact fraction

/// Whether a number has moved by less than 0.5 % of its size; an undefined one does not move.
bool is_steady(double before, double now, double size) {
    if (std::isnan(before) && std::isnan(now)) return true;
    return std::abs(now - before) <= k_change * size;
}

}  // namespace

double Relaxation::latest_end_s(const StageContext& context) const {
    return context.memory.start_s + (parameters_.until == scene::Until::duration
                                         ? parameters_.duration_s
                                         : parameters_.cap_s);
}

StageEnd Relaxation::after_step(StageContext& context) const {
    if (context.state.time_s < latest_end_s(context)) return StageEnd::none;
    return parameters_.until == scene::Until::duration ? StageEnd::done : StageEnd::cap;
}

StageEnd Relaxation::after_measure(StageContext& context, const Totals& totals) const {
    std::vector<double>& samples = context.memory.samples;
    const std::array<double, k_row> row{context.state.time_s, totals.sigma_h_core_kPa,
                                        totals.coordination_Z, totals.contact_fraction};
    samples.insert(samples.end(), row.begin(), row.end());
    // Keep one row that is at least a window old.
    while (samples.size() > 2 * k_row &&
           samples[k_row] <= context.state.time_s - k_window_s * (1.0 - 1e-9))
        samples.erase(samples.begin(), samples.begin() + k_row);
    const bool is_timed = parameters_.until == scene::Until::duration;
    if (is_timed && context.state.time_s < latest_end_s(context)) return StageEnd::none;
    if (context.state.time_s - samples[0] < k_window_s * (1.0 - 1e-9)) return StageEnd::none;

    // Where the core's mean nearly cancels, 0.5 % of it is below what any cell's stress can be
    // steady to.
    const double core_size = std::fmax(std::abs(totals.sigma_h_core_kPa), totals.sigma_h_size_kPa);
    if (!is_steady(samples[1], row[1], core_size) ||
        !is_steady(samples[2], row[2], std::abs(row[2])) ||
        !is_steady(samples[3], row[3], std::abs(row[3])))
        return StageEnd::none;
    // Where every sigma_h is zero (two equal cells), the defect is 0/0: then the mean itself
    // decides.
    const bool no_stress =
        std::abs(totals.sigma_h_mean_kPa) < k_no_stress * totals.mean_pressure_kPa;
    if (!std::isnan(totals.virial_defect) && !(totals.virial_defect < k_virial_defect) &&
        !no_stress)
        return StageEnd::none;
    if (totals.normal_speed_rms_um_per_s < k_rest_speed_um_per_s) return StageEnd::rest;
    const bool has_measures = !std::isnan(row[1]) || !std::isnan(row[2]) || !std::isnan(row[3]);
    return parameters_.until == scene::Until::stationary || (is_timed && has_measures)
               ? StageEnd::stationary
               : StageEnd::none;
}

double Relaxation::progress(const StageContext& context) const {
    if (parameters_.until == scene::Until::duration) return Stage::progress(context);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace spheroscope
