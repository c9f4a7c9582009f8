#include "tests/cli/same_frames.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

namespace spheroscope {
namespace {

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string difference(const Diagnostics& a, const Diagnostics& b) {
    if (a.steps != b.steps) return "steps";
    if (a.rejected_steps != b.rejected_steps) return "rejected steps";
    if (a.linear_iterations != b.linear_iterations) return "linear iterations";
    if (!same_bits(a.dt_s, b.dt_s)) return "dt";
    if (!same_bits(a.force_residual_nN, b.force_residual_nN)) return "force residual";
    if (!same_bits(a.force_balance_nN, b.force_balance_nN)) return "force balance";
    if (!same_bits(a.step_error_um, b.step_error_um)) return "step error";
    if (!same_bits(a.wall_radius_um, b.wall_radius_um)) return "wall radius";
    if (!same_bits(a.wall_force_nN, b.wall_force_nN)) return "wall force";
    return "";
}

}  // namespace

std::string difference(const Snapshot& a, const Snapshot& b) {
    if (a.frame != b.frame || a.stage != b.stage || !same_bits(a.time_s, b.time_s))
        return "number, stage or time";
    if (!same_bits(a.stage_progress, b.stage_progress)) return "progress of the stage";
    if (!same_bits(a.x_um, b.x_um)) return "positions";
    if (!same_bits(a.normal, b.normal)) return "normals";
    if (a.fields.size() != b.fields.size()) return "number of fields";
    for (std::size_t i = 0; i < a.fields.size(); ++i)
        if (!same_bits(a.fields[i], b.fields[i])) return "field " + std::to_string(i);
    if (!same_bits(a.centre_um, b.centre_um)) return "centres";
    if (!same_bits(a.pressure_kPa, b.pressure_kPa)) return "pressures";
    if (!same_bits(a.volume_um3, b.volume_um3)) return "volumes";
    if (a.links.size() != b.links.size()) return "number of contacts";
    for (std::size_t i = 0; i < a.links.size(); ++i)
        if (a.links[i].cell_a != b.links[i].cell_a || a.links[i].cell_b != b.links[i].cell_b ||
            a.links[i].force_nN != b.links[i].force_nN ||
            a.links[i].area_um2 != b.links[i].area_um2)
            return "contact " + std::to_string(i);
    for (const TotalsRow& row : all_totals())
        if (!same_bits(value_of(row, a.totals), value_of(row, b.totals)))
            return std::string(row.name);
    return difference(a.diagnostics, b.diagnostics);
}

std::string difference(const RunFileReader& a, const RunFileReader& b, int n) {
    for (int frame = 0; frame < n; ++frame) {
        const std::string what = difference(*a.frame(frame), *b.frame(frame));
        if (!what.empty()) return "frame " + std::to_string(frame) + ": " + what;
    }
    return "";
}

}  // namespace spheroscope
