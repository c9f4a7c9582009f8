#include "engine/statistics/motion_at_end.hpp"

#include "engine/stages/relaxation.hpp"

#include <fmt/format.h>

namespace spheroscope::statistics {

bool is_faster_than_rest(double normal_speed_rms_um_per_s) {
    return normal_speed_rms_um_per_s >= k_rest_speed_um_per_s;  // false where it is undefined
}

std::string remark_on_motion(std::span<const MotionAtEnd> runs) {
    std::string seeds, speeds;
    for (const MotionAtEnd& run : runs) {
        if (!is_faster_than_rest(run.normal_speed_rms_um_per_s)) continue;
        seeds += fmt::format("{}{} ({})", seeds.empty() ? "seed " : ", ", run.seed,
                             run.outcome.empty() ? "not ended" : run.outcome);
        speeds +=
            fmt::format("{}{:.2g}", speeds.empty() ? "" : ", ", run.normal_speed_rms_um_per_s);
    }
    if (seeds.empty()) return "";
    return fmt::format("{}: nodes still move with {} um/s (at rest: less than {:g})", seeds, speeds,
                       k_rest_speed_um_per_s);
}

}  // namespace spheroscope::statistics
