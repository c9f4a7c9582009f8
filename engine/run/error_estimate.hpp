#pragma once

#include "engine/measures/totals.hpp"
#include "engine/model/state.hpp"
#include "engine/solve/method.hpp"

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope {

/// How wrong one measure of a run's end is thought to be, in the measure's unit; NaN: not known.
/// Errors are measured, by a second run, or there is none: on the motions of scenes/bench nothing
/// that one run shows of itself came near (engine/README.md, 'How wrong').
struct MeasureError {
    std::string measure;  ///< name of the row of the table of totals
    std::string unit;
    double value = 0.0;
    double time =
        std::numeric_limits<double>::quiet_NaN();  ///< by the finite steps (companion.hpp)
    double mesh = std::numeric_limits<double>::quiet_NaN();  ///< by the finite mesh
    /// What may still come before rest: no error of this state, and not measured.
    double rest = std::numeric_limits<double>::quiet_NaN();
    std::string halves_time = "";  ///< advice_on_time_steps of the run's method; "": it has no time

    /// Root of the sum of the squares of the measured errors; NaN if none is.
    [[nodiscard]] double measured() const;
    /// Neither the measured error nor what may still come is larger than the value.
    [[nodiscard]] bool is_resolved() const;
    /// The largest part, and what would halve it, in words; "" if no part is known.
    [[nodiscard]] std::string advice() const;
};

/// What halves the error by the finite steps of this method: its order says how much shorter they
/// must be, the order of its error estimate how much less the tolerance. "" where there is no such
/// error.
[[nodiscard]] std::string advice_on_time_steps(const MethodRow& method, bool are_fixed);

/// The rows of the table of totals that error estimates are made for.
[[nodiscard]] std::span<const std::string_view> estimated_measures();

/// Whether the errors leave a row of the table of totals its number: a row that has an error of its
/// own, or that follows from such a row (eps_YL from sigma_h_core) or is bounded by it
/// (sigma_h_mean by sigma_h_size). True for all others.
[[nodiscard]] bool is_resolved(const TotalsRow& row, std::span<const MeasureError> errors);

/// What a run collects on its way to say how far its end is from rest.
///
/// What ends before rest has left dm/dt over lambda, with lambda the rate at which the speed has
/// fallen lately; where it does not fall, what as much time again as the stage's would bring.
class ApproachToRest {
  public:
    /// After an accepted step of dt_s.
    void after_step(double dt_s) { memory.dt_s = dt_s; }
    /// At a measurement: the speed then, RMS over all nodes.
    void after_measurement(double time_s, std::span<const Vec3> v_um_per_s);
    /// The cells are on another mesh now, and have made no step on it.
    void forget_step() { memory.dt_s = 0.0; }

    /// The time that is missing until rest; NaN while there are too few steps. stage_s: how long
    /// the stage has lasted.
    [[nodiscard]] double missing_time_s(double stage_s) const;
    [[nodiscard]] double last_step_s() const { return memory.dt_s; }

    /// For checkpoints.
    struct Memory {
        double dt_s = 0.0;              ///< of the last step; 0: there was none
        double time_s[2] = {0.0, 0.0};  ///< of the last measurements, newest first
        double speed_um_per_s[2] = {0.0, 0.0};
    };
    Memory memory;
};

/// The measures at the end, without errors; `before`: those at the start of the last step,
/// last_step_s before, for what missing_time_s may still bring; nullptr: not asked for.
[[nodiscard]] std::vector<MeasureError> measure_errors(const Totals& end, const Totals* before,
                                                       double last_step_s, double missing_time_s);

/// Adds the error of the mesh from the same run on coarser meshes, each of half the fineness of the
/// one before, the finest of them first: one, or two where there are as many. Areas and energies
/// converge with the square of the edge length, so a mesh is wrong by a third of its difference to
/// the coarser one. Stresses cross their limit, and where they do the last difference is small by
/// accident: it counts as no less than a quarter of the one before.
void add_mesh_error(std::vector<MeasureError>& errors, std::span<const Totals> coarser);

}  // namespace spheroscope
