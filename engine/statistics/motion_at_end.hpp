#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace spheroscope::statistics {

/// How fast a run still moves in its last frame.
struct MotionAtEnd {
    std::uint64_t seed = 0;
    std::string outcome;                     ///< "" while the run goes on
    double normal_speed_rms_um_per_s = 0.0;  ///< Totals of the frame; NaN: not known
};

/// Whether it moves as no state at rest does, by the speed that a relaxation wants of one. Earlier
/// versions recorded as a run's outcome what a stage before the last one had found: the word may
/// be `rest` all the same.
[[nodiscard]] bool is_faster_than_rest(double normal_speed_rms_um_per_s);

/// "seed 1 (rest), 3 (cap): nodes still move with 0.0012, 0.0031 um/s ...", for runs of one setup;
/// "" where each of them is as slow as at rest.
[[nodiscard]] std::string remark_on_motion(std::span<const MotionAtEnd> runs);

}  // namespace spheroscope::statistics
