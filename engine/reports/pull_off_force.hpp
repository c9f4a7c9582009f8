#pragma once

#include "engine/reports/plot.hpp"
#include "engine/scene/scene.hpp"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// Two cells that are pulled apart by a force that grows slowly until they part.
/// Problem of a variant whose turn had not come when everything was stopped.
inline constexpr const char* k_not_run = "stopped before its turn";

struct PullOff {
    std::string variant;  ///< of the scene
    double E_kPa = 0.0;
    double Et_over_gamma = 0.0;
    double area_at_rest_um2 = 0.0;
    double force_nN = 0.0;     ///< the largest one that the contact has held
    double over_pi_R_W = 0.0;  ///< over pi R W, what a liquid-like pair of spheres holds
    double time_s = 0.0;       ///< model time, rest and pulling
    std::int64_t steps = 0;
    std::string problem;  ///< why there is no number; "" if there is one
};

struct PullOffOptions {
    double rate_nN_per_s = 0.05;
    int threads = 1;
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& variant, double share)> progress{};
};

/// Runs the stages of every variant of the scene, then pulls on both cells, spread by rest area,
/// along the line between their centres. The force is constant for half a second at a time. Parted
/// are cells that no pair of triangles joins any more. Throws Error when the scene has not two
/// cells of one radius, no adhesion, no tension, no elasticity, a method or stages that have no
/// model time. A pair that does not touch at rest, or cannot be parted, is a row with its problem.
[[nodiscard]] std::vector<PullOff> measure_pull_off(const std::string& file,
                                                    const std::vector<scene::Override>& overrides,
                                                    const PullOffOptions& options);

/// F / pi R W over E t / gamma.
[[nodiscard]] Plot pull_off_plot(const std::vector<PullOff>& rows);

}  // namespace spheroscope::reports
