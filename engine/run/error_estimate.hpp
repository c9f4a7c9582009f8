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
struct MeasureError {
    std::string measure;  ///< name of the row of the table of totals
    std::string unit;
    double value = 0.0;
    double time = std::numeric_limits<double>::quiet_NaN();  ///< by the finite steps
    double rest = std::numeric_limits<double>::quiet_NaN();  ///< by ending before rest
    double mesh = std::numeric_limits<double>::quiet_NaN();  ///< by the finite mesh, if asked for
    bool time_is_measured = false;  ///< `time` is from a second run, else a guess
    std::string halves_time = "";   ///< advice_on_time_steps of the run's method

    /// Root of the sum of the squares of those that are known; NaN if none is.
    [[nodiscard]] double total() const;
    /// The error is not larger than the value.
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

/// What a run collects on its way to say how wrong its end is.
///
/// For x' = f(x) a method of order p with steps dt_n makes the error e(t) that solves
/// e' = f'(x) e + c dt^p x^(p+1), to leading order. Since f' x' = x'', and so on for the next
/// derivatives where f is nearly linear, e = c (sum of dt_n^(p+1)) x^(p+1)(t) is its solution: what
/// all steps have left behind, propagated to the end, is seen in the last velocities alone. It
/// vanishes at rest, as it must. Velocities that fall at a rate lambda give x^(p+1) = lambda^p x',
/// which stays among the motions that the cells really make; differences of velocities do not, and
/// a displacement by a hundredth of h0 against a contact changes stresses more than a whole run
/// does. So a measure m is wrong by c (sum of dt_n^(p+1)) lambda^p dm/dt. Motions with contacts are
/// not nearly linear, and nothing moves at rest: a guess. companion.hpp measures it.
///
/// What ends before rest has left dm/dt over lambda, with lambda the rate at which the speed has
/// fallen lately; where it does not fall, what as much time again as the stage's would bring.
class ErrorCollector {
  public:
    /// After an accepted step of dt_s that left v in the state.
    void after_step(double dt_s, std::span<const Vec3> v_um_per_s);
    /// At a measurement: the speed then, RMS over all nodes.
    void after_measurement(double time_s, std::span<const Vec3> v_um_per_s);
    /// The cells are on another mesh now.
    void forget_velocities();

    /// What the error by time steps of a method of this order is over dm/dt, s; NaN while there are
    /// too few steps or the order is 0.
    [[nodiscard]] double time_error_s(int order) const;
    /// The same for what is left to do; stage_s: how long the stage has lasted.
    [[nodiscard]] double missing_time_s(double stage_s) const;
    /// From the end back to where the last step began [all nodes], um.
    [[nodiscard]] std::vector<Vec3> last_step_back_um() const;
    [[nodiscard]] double last_step_s() const { return memory.dt_s[0]; }

    /// For checkpoints.
    struct Memory {
        double sum_dt2_s2 = 0.0, sum_dt3_s3 = 0.0;
        double dt_s[3] = {0.0, 0.0, 0.0};  ///< of the last steps, newest first
        double time_s[2] = {0.0, 0.0};     ///< of the last measurements, newest first
        double speed_um_per_s[2] = {0.0, 0.0};
        std::vector<Vec3> v_um_per_s[3];  ///< of the last steps, newest first
    };
    Memory memory;
};

/// Estimates from the measures at the end and at the start of the last step, last_step_s before,
/// with the times of ErrorCollector; a NaN leaves a part unknown.
[[nodiscard]] std::vector<MeasureError> measure_errors(const Totals& end, const Totals* before,
                                                       double last_step_s, double time_error_s,
                                                       double missing_time_s);

/// Adds the error of the mesh from the same run on the mesh of half the fineness: areas and
/// energies converge with the square of the edge length (engine/README.md, 'How wrong'), so the
/// finer one is wrong by a third of the difference.
void add_mesh_error(std::vector<MeasureError>& errors, const Totals& coarser);

}  // namespace spheroscope
