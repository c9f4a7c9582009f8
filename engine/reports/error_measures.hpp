#pragma once

#include "engine/reports/measured_run.hpp"

#include <span>
#include <string_view>

namespace spheroscope::reports {

/// What makes errors numbers without a unit.
struct ErrorScales {
    double length_um = 0.0;     ///< the range of adhesion h0; without contacts, the shortest edge
    double pressure_kPa = 0.0;  ///< mean pressure: a stress far below it is no stress
    double tension_nN_per_um = 0.0;  ///< the same for tensions: pressure times length
};
[[nodiscard]] ErrorScales error_scales(const scene::Scene& scene, const MeasuredRun& reference);

/// One way to say how far a run is from a reference run of the same scene and mesh.
struct ErrorMeasure {
    std::string_view name;   ///< column of the table, key in JSON
    std::string_view title;  ///< of its panel in a plot; UTF-8; empty: not drawn
    std::string_view unit;   ///< of the number, for the axis
    std::string_view description;
    /// NaN where there is nothing to compare (no contact, no stress).
    double (*compute)(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales&);
    /// Error that the run's own number format leaves: frames carry fields in single precision.
    double resolution;
};
[[nodiscard]] std::span<const ErrorMeasure> all_error_measures();

/// All of them, in the order of the table. Both runs have come to the end of the same stages.
[[nodiscard]] std::vector<double>
compute_errors(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales& scales);

/// RMS distance of the nodes after the rigid motion that makes it smallest, um (Kabsch 1976).
[[nodiscard]] double rms_distance_of_shapes_um(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace spheroscope::reports
