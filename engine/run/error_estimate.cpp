#include "engine/run/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace spheroscope {
namespace {

constexpr std::array<std::string_view, 6> k_measures{
    "contact_area", "contact_fraction", "sigma_h_core", "sigma_h_rim", "sigma_h_size", "energy"};

/// c of the local error c dt^(p+1) x^(p+1). An Euler method with the exact derivative has 1/2. With
/// a positive semi-definite K in its place more is left, and steps of the past were taken where
/// the motion was faster than it is at the end: measured on the scenes of scenes/bench
/// (engine/README.md, 'How wrong').
constexpr double k_first_order = 2.5;
constexpr double k_second_order = 0.5;

double rms(std::span<const Vec3> v) {
    double sum = 0.0;
    for (const Vec3& u : v) sum += u.squaredNorm();
    return v.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(v.size()));
}

}  // namespace

double MeasureError::total() const {
    double sum = 0.0;
    bool is_known = false;
    for (const double part : {time, rest, mesh})
        if (!std::isnan(part)) {
            sum += part * part;
            is_known = true;
        }
    return is_known ? std::sqrt(sum) : std::numeric_limits<double>::quiet_NaN();
}

bool MeasureError::is_resolved() const { return !(total() > std::abs(value)); }

std::string MeasureError::advice() const {
    const auto size = [](double part) { return std::isnan(part) ? -1.0 : part; };
    const double largest = std::max({size(time), size(rest), size(mesh)});
    if (largest < 0.0) return "";
    if (largest == size(mesh)) return "mesh: a finer mesh (cells.nodes) divides it by 4";
    if (largest == size(rest)) return "not at rest: a longer relaxation halves it";
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

void ErrorCollector::after_step(double dt_s, std::span<const Vec3> v_um_per_s) {
    Memory& m = memory;
    m.sum_dt2_s2 += dt_s * dt_s;
    m.sum_dt3_s3 += dt_s * dt_s * dt_s;
    std::swap(m.v_um_per_s[2], m.v_um_per_s[1]);  // the oldest array is written over
    std::swap(m.v_um_per_s[1], m.v_um_per_s[0]);
    m.v_um_per_s[0].assign(v_um_per_s.begin(), v_um_per_s.end());
    m.dt_s[2] = m.dt_s[1];
    m.dt_s[1] = m.dt_s[0];
    m.dt_s[0] = dt_s;
}

void ErrorCollector::after_measurement(double time_s, std::span<const Vec3> v_um_per_s) {
    memory.time_s[1] = memory.time_s[0];
    memory.speed_um_per_s[1] = memory.speed_um_per_s[0];
    memory.time_s[0] = time_s;
    memory.speed_um_per_s[0] = rms(v_um_per_s);
}

void ErrorCollector::forget_velocities() {
    for (std::vector<Vec3>& v : memory.v_um_per_s) v.clear();
}

double ErrorCollector::time_error_s(int order) const {
    const Memory& m = memory;
    if (order < 1 || m.v_um_per_s[0].empty() || m.v_um_per_s[1].size() != m.v_um_per_s[0].size())
        return std::numeric_limits<double>::quiet_NaN();
    // A velocity belongs to the middle of its step.
    const double between_s = 0.5 * (m.dt_s[0] + m.dt_s[1]);
    const double now = rms(m.v_um_per_s[0]), before = rms(m.v_um_per_s[1]);
    if (now == 0.0 || before == 0.0) return 0.0;
    const double rate_per_s = std::abs(std::log(before / now)) / between_s;
    return order == 1 ? k_first_order * m.sum_dt2_s2 * rate_per_s
                      : k_second_order * m.sum_dt3_s3 * rate_per_s * rate_per_s;
}

double ErrorCollector::missing_time_s(double stage_s) const {
    const Memory& m = memory;
    const double span_s = m.time_s[0] - m.time_s[1];
    if (m.v_um_per_s[0].empty() || !(span_s > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    const double rate_per_s = m.speed_um_per_s[0] > 0.0
                                  ? std::log(m.speed_um_per_s[1] / m.speed_um_per_s[0]) / span_s
                                  : 0.0;
    return rate_per_s * stage_s > 1.0 ? 1.0 / rate_per_s : stage_s;
}

std::vector<Vec3> ErrorCollector::last_step_back_um() const {
    std::vector<Vec3> back;
    back.reserve(memory.v_um_per_s[0].size());
    for (const Vec3& v : memory.v_um_per_s[0]) back.push_back(-memory.dt_s[0] * v);
    return back;
}

std::vector<MeasureError> measure_errors(const Totals& end, const Totals* before,
                                         double last_step_s, double time_error_s,
                                         double missing_time_s) {
    std::vector<MeasureError> errors;
    for (const TotalsRow& row : all_totals()) {
        if (std::find(k_measures.begin(), k_measures.end(), row.name) == k_measures.end()) continue;
        MeasureError error;
        error.measure = row.name;
        error.unit = row.unit;
        error.value = value_of(row, end);
        if (std::isnan(error.value)) continue;
        if (before != nullptr) {
            const double per_s = std::abs(error.value - value_of(row, *before)) / last_step_s;
            error.time = time_error_s * per_s;
            error.rest = missing_time_s * per_s;
        }
        errors.push_back(std::move(error));
    }
    return errors;
}

void add_mesh_error(std::vector<MeasureError>& errors, const Totals& coarser) {
    constexpr double factor = 1.0 / 3.0;
    for (MeasureError& error : errors)
        for (const TotalsRow& row : all_totals())
            if (row.name == error.measure)
                error.mesh = factor * std::abs(value_of(row, coarser) - error.value);
}

}  // namespace spheroscope
