#pragma once

#include "engine/base/repetitions.hpp"
#include "engine/reports/error_measures.hpp"
#include "engine/solve/method.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// A method with everything that decides how exact it is.
struct MethodSetting {
    const MethodRow* method = nullptr;
    double dt_s = 0.0;          ///< fixed step, or the first one
    double tolerance_um = 0.0;  ///< 0: fixed steps of dt_s
    double linear_tolerance = 1e-3;

    [[nodiscard]] bool is_fixed() const { return tolerance_um == 0.0; }
    /// "dt = 3.85 ms", "tolerance = 6 nm"
    [[nodiscard]] std::string text() const;
    [[nodiscard]] scene::Scene applied_to(const scene::Scene& scene) const;
};

/// The setting of the scene itself.
[[nodiscard]] MethodSetting own_setting(const scene::Scene& scene);

/// The tolerance of an adaptive method in this scene: its own, or the standard where it has fixed
/// steps.
[[nodiscard]] double standard_tolerance_um(const scene::Scene& scene);

/// n_levels settings of a method, coarse to fine, around the scene's own: steps in factors of 2
/// where steps are fixed, tolerances in factors of 4 where they adapt, which is a factor of 2 in
/// the step of a first-order method. The tolerance of the linear solver falls with them.
[[nodiscard]] std::vector<MethodSetting> ladder(const MethodRow& method, const scene::Scene& scene,
                                                int n_levels);

struct PrecisionRow {
    MethodSetting setting;
    bool was_run = false;        ///< false: the time limit came first
    MeasuredRun run;             ///< without its samples; times are the least of all repetitions
    int n_runs = 0;              ///< repetitions that were made
    std::vector<double> errors;  ///< one for each error measure; empty unless it can be compared
};

struct Precision {
    std::vector<PrecisionRow> rows;
    // The reference, and what is known of its own error.
    std::optional<MethodSetting> reference;  ///< none: no run could serve as one
    MeasuredRun reference_run;               ///< without its samples
    MethodSetting second;  ///< the same at twice the step, against which it is checked
    std::vector<double> reference_errors;  ///< of the reference, from the difference of the two
    ErrorScales scales;
    /// What the contact kernel's single precision changes: the difference of the reference to the
    /// same run in double, one for each error measure. Empty where the scene's kernel is double, or
    /// there are no contacts of `traction`, or the run did not come to its end.
    std::vector<double> cost_of_floats;
    bool met_time_limit = false;

    /// The error of a row can be told from that of the reference: it is ten times as large.
    [[nodiscard]] bool is_resolved(const PrecisionRow& row, std::size_t measure) const;
    /// No row is hidden by the reference's own error, in any measure.
    [[nodiscard]] bool reference_is_fine_enough() const;
};

struct PrecisionOptions {
    int threads = 1;
    int n_levels = 5;
    int n_outputs = 8;                ///< fixed output times, a power of two
    int most_reference_halvings = 7;  ///< of the scene's step, until the reference is fine enough
    double wall_limit_s = 0.0;        ///< of everything together; 0: none
    /// Of a row of the table: runs that take milliseconds are told apart by their least time.
    Repetitions repetitions{.most = 5, .longest_s = 0.5};
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& what, double share)> progress{};  ///< may be empty
};

/// Runs every method of the table over its ladder, then a reference: fixed steps of the method with
/// the highest order (of several, of the one with the cheapest step), halved until its difference
/// to the run at twice the step is a tenth of the smallest error in the table. Rows and reference
/// share the kernel of the contacts; where that is in floats, the reference is run once more in
/// double. Throws Error when the scene's outputs would depend on the method (with_fixed_outputs).
[[nodiscard]] Precision compute_precision(const scene::Scene& scene,
                                          const PrecisionOptions& options);

}  // namespace spheroscope::reports
