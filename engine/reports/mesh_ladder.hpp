#pragma once

#include "engine/reports/precision.hpp"

namespace spheroscope::reports {

/// A number of the end state that has a limit for fine meshes.
struct MeshMeasure {
    std::string_view name, unit;
    double (*value)(const MeasuredRun&);  ///< NaN where there is nothing to measure
};
[[nodiscard]] std::span<const MeshMeasure> all_mesh_measures();

/// Limit of a sequence on meshes of edge h, h/2, h/4 by Richardson's extrapolation.
struct Extrapolation {
    double order = 0.0;  ///< observed: log2 of the ratio of successive differences
    double limit = 0.0;
    /// The differences have one sign and shrink; else order and limit are NaN.
    bool is_resolved = false;
};
/// From the last three values; not resolved with fewer.
[[nodiscard]] Extrapolation extrapolate(std::span<const double> values);

struct MeshLevel {
    int nodes = 0;
    bool was_run = false;  ///< false: the time limit came first
    MeasuredRun run;
};

/// What is known of one measure.
struct MeshResult {
    std::vector<double> values;  ///< one for each level; NaN where the run failed
    Extrapolation extrapolation;
    double mesh_error = 0.0;  ///< of the scene's own mesh, relative; NaN: not known
    /// The mesh error is the difference to the finest level, where no limit could be extrapolated:
    /// its size, not its digits.
    bool mesh_error_is_rough = false;
    double time_error = 0.0;  ///< of the scene's own step on its own mesh, relative; NaN: not known

    /// Which error is the larger one: "mesh", "time", or "unknown" where either is not known.
    [[nodiscard]] std::string_view dominant() const;
};

struct MeshLadder {
    std::vector<MeshLevel> levels;  ///< at the finer setting
    MethodSetting own, finer;       ///< the scene's setting, and that of the levels
    MeshLevel own_run;              ///< the scene's mesh at its own setting
    MeshLevel finer_run;            ///< and at the finer one, also where that is beyond the levels
    std::vector<MeshResult> results;  ///< one for each mesh measure
    bool met_time_limit = false;
};

/// Runs the scene with a far finer setting on all mesh levels up to most_nodes, so that they differ
/// by the mesh alone, and on its own mesh with its own setting as well: what that differs by is the
/// time error.
[[nodiscard]] MeshLadder compute_mesh_ladder(const scene::Scene& scene, int most_nodes,
                                             const PrecisionOptions& options);

}  // namespace spheroscope::reports
