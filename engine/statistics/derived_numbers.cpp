#include "engine/statistics/derived_numbers.hpp"

#include "engine/statistics/tension_by_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace spheroscope::statistics {
namespace {

const SetupNumber* find(const std::vector<SetupNumber>& numbers, const std::string& name) {
    const auto at = std::find_if(numbers.begin(), numbers.end(),
                                 [&](const SetupNumber& number) { return number.name == name; });
    return at == numbers.end() ? nullptr : &*at;
}

double droplet_ratio(double core_kPa, double R_um, double outside_nN_per_um,
                     double inside_nN_per_um) {
    return -core_kPa * R_um / (2.0 * (outside_nN_per_um - inside_nN_per_um));
}

}  // namespace

void add_derived_numbers(std::vector<SetupNumber>& numbers, std::string_view law) {
    const std::string name = "core_over_2Gamma_R";
    const auto tension = [](Region region) { return "gamma_eff, " + std::string(name_of(region)); };
    const std::array parts{find(numbers, "sigma_h_core"), find(numbers, "R_th"),
                           find(numbers, tension(Region::rim)),
                           find(numbers, tension(Region::core))};
    if (law != "traction" || find(numbers, name) != nullptr ||
        std::find(parts.begin(), parts.end(), nullptr) != parts.end())
        return;
    const auto& [core, R, outside, inside] = parts;
    SetupNumber ratio{name, "1", {}};
    if (std::none_of(parts.begin(), parts.end(),
                     [](const SetupNumber* part) { return part->by_run.empty(); })) {
        for (std::size_t run = 0; run < core->by_run.size(); ++run)
            ratio.by_run.push_back(droplet_ratio(core->by_run[run], R->by_run[run],
                                                 outside->by_run[run], inside->by_run[run]));
        ratio.estimate = mean_over_seeds(ratio.by_run);
    } else {
        const Estimate &s = core->estimate, &o = outside->estimate, &i = inside->estimate;
        ratio.estimate.mean = droplet_ratio(s.mean, R->estimate.mean, o.mean, i.mean);
        ratio.estimate.n = std::min({s.n, o.n, i.n});
        ratio.estimate.standard_error =
            std::abs(ratio.estimate.mean) *
            std::hypot(s.standard_error / s.mean, R->estimate.standard_error / R->estimate.mean,
                       std::hypot(o.standard_error, i.standard_error) / (o.mean - i.mean));
    }
    numbers.push_back(std::move(ratio));
}

}  // namespace spheroscope::statistics
