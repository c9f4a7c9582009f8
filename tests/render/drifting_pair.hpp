#pragma once

#include "render/frame_source.hpp"
#include "tests/render/synthetic.hpp"

#include <memory>
#include <string>

namespace spheroscope::render {

/// Two cells that drift apart while their stress grows, a frame each quarter of a second; "compact"
/// until frame n_frames / 2, then "relax".
class DriftingPair : public FrameSource {
  public:
    explicit DriftingPair(int n_frames, float stress_kPa = 0.01F, double drift_um = 0.2)
        : n_frames_(n_frames), stress_kPa_(stress_kPa), drift_um_(drift_um) {}
    int n_frames() override { return n_frames_; }
    SnapshotPtr frame(int i) override {
        const double shift = drift_um_ * i;
        auto snapshot =
            synthetic::make_balls(header_, {{0, -9 - shift, 0}, {0, 9 + shift, 0}}, 9.0);
        snapshot->frame = i;
        snapshot->time_s = 0.25 * i;
        snapshot->stage_name = i < n_frames_ / 2 ? "compact" : "relax";
        snapshot->fields[2] = {stress_kPa_ * static_cast<float>(i + 1), -stress_kPa_};
        snapshot->totals.sigma_h_core_kPa = 0.01 * i * i;
        return snapshot;
    }

  private:
    int n_frames_;
    float stress_kPa_;
    double drift_um_;
    std::shared_ptr<const RunHeader> header_ = synthetic::make_header(2, 42);
};

}  // namespace spheroscope::render
