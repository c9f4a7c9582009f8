#include "engine/run/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace spheroscope {
namespace {

constexpr std::array<std::string_view, 7> k_measures{
    "contact_area",           "contact_fraction", "sigma_h_core", "sigma_h_rim",
    "sigma_h_core_by_volume", "sigma_h_size",     "energy"};

double rms(std::span<const Vec3> v) {
    double sum = 0.0;
    for (const Vec3& u : v) sum += u.squaredNorm();
    return v.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(v.size()));
}

/// Of those that are known; NaN if none is.
double root_of_squares(std::initializer_list<double> parts) {
    double sum = 0.0;
    bool is_known = false;
    for (const double part : parts)
        if (!std::isnan(part)) {
            sum += part * part;
            is_known = true;
        }
    return is_known ? std::sqrt(sum) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double MeasureError::measured() const { return root_of_squares({time, mesh}); }

bool MeasureError::is_resolved() const {
    return !(root_of_squares({time, mesh, rest}) > std::abs(value));
}

std::string MeasureError::advice() const {
    const auto size = [](double part) { return std::isnan(part) ? -1.0 : part; };
    const double largest = std::max({size(time), size(rest), size(mesh)});
    if (largest < 0.0) return "";
    if (largest == size(mesh))
        // Stresses have no common order: the corners that carry them move with the mesh.
        return measure.starts_with("sigma_h")
                   ? "mesh: a finer mesh (cells.nodes) makes it smaller; `precision --mesh` "
                     "says by how much"
                   : "mesh: one with four times as many nodes (cells.nodes) divides it by about 4";
    if (largest == size(rest)) return "what still moves: a longer relaxation halves it";
    return "time steps" + (halves_time.empty() ? "" : ": " + halves_time);
}

std::string advice_on_time_steps(const MethodRow& method, bool are_fixed) {
    if (!method.moves_in_time()) return "";
    const double shorter = std::pow(0.5, 1.0 / method.order);
    if (are_fixed) return fmt::format("{:.2g} times method.dt halves it", shorter);
    std::string text =
        fmt::format("{:.2g} times method.tolerance with {:.2g} times method.displacement_bound "
                    "and method.dt_max halves it",
                    std::pow(shorter, method.estimate_order), shorter);
    // Its K is not the derivative of a force that grows with the contact (engine/README.md, 'How
    // wrong'), so the error there falls more slowly than its order says.
    if (method.order == 1 && method.needs_stiffness)
        text += fmt::format("; while contacts grow {} is late with any step (methods of second "
                            "order are not)",
                            method.name);
    return text;
}

std::span<const std::string_view> estimated_measures() { return k_measures; }

bool is_resolved(const TotalsRow& row, std::span<const MeasureError> errors) {
    std::string_view decided_by = row.name;
    if (row.name == "eps_YL_omega" || row.name == "eps_YL_W") decided_by = "sigma_h_core";
    if (row.name == "sigma_h_mean") decided_by = "sigma_h_size";  // never smaller
    return std::none_of(errors.begin(), errors.end(), [&](const MeasureError& error) {
        return error.measure == decided_by && !error.is_resolved();
    });
}

void ApproachToRest::after_measurement(double time_s, std::span<const Vec3> v_um_per_s) {
    memory.time_s[1] = memory.time_s[0];
    memory.speed_um_per_s[1] = memory.speed_um_per_s[0];
    memory.time_s[0] = time_s;
    memory.speed_um_per_s[0] = rms(v_um_per_s);
}

double ApproachToRest::missing_time_s(double stage_s) const {
    const Memory& m = memory;
    const double span_s = m.time_s[0] - m.time_s[1];
    if (m.dt_s == 0.0 || !(span_s > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    const double rate_per_s = m.speed_um_per_s[0] > 0.0
                                  ? std::log(m.speed_um_per_s[1] / m.speed_um_per_s[0]) / span_s
                                  : 0.0;
    return rate_per_s * stage_s > 1.0 ? 1.0 / rate_per_s : stage_s;
}

std::vector<MeasureError> measure_errors(const Totals& end, const Totals* before,
                                         double last_step_s, double missing_time_s) {
    std::vector<MeasureError> errors;
    for (const TotalsRow& row : all_totals()) {
        if (std::find(k_measures.begin(), k_measures.end(), row.name) == k_measures.end()) continue;
        MeasureError error;
        error.measure = row.name;
        error.unit = row.unit;
        error.value = value_of(row, end);
        if (std::isnan(error.value)) continue;
        if (before != nullptr)
            error.rest =
                missing_time_s * std::abs(error.value - value_of(row, *before)) / last_step_s;
        errors.push_back(std::move(error));
    }
    return errors;
}

void add_mesh_error(std::vector<MeasureError>& errors, std::span<const Totals> coarser) {
    SPHEROSCOPE_ASSERT(!coarser.empty(), "a coarser mesh");
    for (MeasureError& error : errors) {
        const TotalsRow& row = *find_total(error.measure);
        double finer = error.value, difference = 0.0;
        for (std::size_t k = 0; k < coarser.size(); ++k) {
            const double value = value_of(row, coarser[k]);
            difference = std::max(difference, std::abs(value - finer) * std::pow(0.25, k));
            finer = value;
        }
        error.mesh = difference / 3.0;
    }
}

}  // namespace spheroscope
