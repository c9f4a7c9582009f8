#pragma once

#include "engine/stages/stage.hpp"

namespace spheroscope {

/// No state at rest moves as fast: RMS of the nodes' speed along their normals.
inline constexpr double k_rest_speed_um_per_s = 1e-3;

/// Nothing acts but the cells themselves.
///
/// `rest` means all of: RMS normal node velocity < k_rest_speed_um_per_s; |sum V sigma_h| < 1 % of
/// sum V |sigma_h|, unless every sigma_h is zero (two equal cells); core sigma_h, Z and contact
/// fraction change by less than 0.5 % in 5 s, core sigma_h by 0.5 % of the mean |sigma_h| where
/// that is larger (the core's mean is a difference of pulled and pressed cells). `stationary` asks
/// for the last two only: soft meshes creep along their surface for minutes while nothing that is
/// measured moves; the creep is reported. A stage that reaches its cap ends as `cap`, and that is
/// never called converged. Numbers that a scene has not (no contacts, no core cells) are left out
/// of the condition.
///
/// A relaxation of fixed duration is judged in the same way, once, at its end: `done` if neither
/// holds there, whatever one before it has found. The 5 s may begin in that one.
class Relaxation final : public Stage {
  public:
    using Stage::Stage;
    [[nodiscard]] double latest_end_s(const StageContext& context) const override;
    [[nodiscard]] StageEnd after_step(StageContext& context) const override;
    [[nodiscard]] StageEnd after_measure(StageContext& context,
                                         const Totals& totals) const override;
    [[nodiscard]] double progress(const StageContext& context) const override;
};

}  // namespace spheroscope
