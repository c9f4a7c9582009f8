#pragma once

#include "engine/run/engine.hpp"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// Positions at one of the fixed output times.
struct Sample {
    double time_s = 0.0;
    std::vector<Vec3> x_um;  ///< [all nodes]
};

/// What a run is judged by, at its end.
struct EndMeasures {
    std::vector<double> volume_um3;          ///< [cells]
    std::vector<float> gamma_eff_nN_per_um;  ///< [all nodes]; empty without elasticity
    std::vector<float> sigma_h_kPa;          ///< [cells]; empty without contacts
    std::vector<ContactLink> links;
    Totals totals{};
};

/// One run of a scene, with what it cost and what came out.
struct MeasuredRun {
    RunVerdict verdict = RunVerdict::finished;
    std::string outcome, message;  ///< as in RunResult
    double time_s = 0.0;           ///< model time reached
    double wall_s = 0.0, cpu_s = 0.0;
    Work work;
    std::uint64_t state_hash = 0;
    std::vector<Sample> samples;
    EndMeasures end;
    double largest_step_um = 0.0;     ///< largest displacement of a node in an accepted step
    double fastest_rate_per_s = 0.0;  ///< largest that an explicit method estimated; 0: none
    int most_flipped_triangles = 0;   ///< at any output, or after any step that was watched

    /// The run came to the end of its stages.
    [[nodiscard]] bool is_complete() const {
        return verdict == RunVerdict::finished || verdict == RunVerdict::cap;
    }
};

struct MeasuredRunOptions {
    int threads = 1;
    double wall_limit_s = 0.0;                ///< 0: none
    const std::atomic<bool>* stop = nullptr;  ///< ends the run when true; may be null
    std::int64_t max_steps = 0;               ///< then the run is stopped; 0: no limit
    bool watch_steps = false;                 ///< fill largest_step_um; a copy of x for each step
    bool watch_flips = false;                 ///< look for flipped triangles after each step
};

/// Triangles that face the centre of their cell: those of Totals::n_flipped_triangles, of all cells
/// with the nodes x_um.
[[nodiscard]] int count_flipped_triangles(const MeshTopology& mesh, std::span<const Vec3> x_um);

/// Runs the scene in this thread, keeps the positions of every output of its last stage, in double,
/// and the measures of the end. Throws Error as Engine does.
[[nodiscard]] MeasuredRun measure_run(const scene::Scene& scene, const MeasuredRunOptions& options);

/// The scene with n_outputs (a power of two) equally spaced outputs in its last stage, none before,
/// no pictures, and the fields that EndMeasures needs. Throws Error if the times of the outputs
/// would depend on the method: stages that end on a condition, or cells from a file.
[[nodiscard]] scene::Scene with_fixed_outputs(const scene::Scene& scene, int n_outputs);

/// The fields of EndMeasures alone, whatever the stages are.
[[nodiscard]] scene::Scene with_report_fields(const scene::Scene& scene);

/// Rest length of the shortest edge of the scene's smallest cell, um; of a packing, of its mean.
[[nodiscard]] double edge_um(const scene::Scene& scene);

}  // namespace spheroscope::reports
