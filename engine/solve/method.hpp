#pragma once

#include "engine/solve/system.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace spheroscope {

/// What a step did. A failed one leaves the state as it was, to the bit.
struct [[nodiscard]] StepOutcome {
    bool accepted = false;
    double dt_s = 0.0;
    /// Estimate of the local error: RMS over the nodes of a cell, the largest cell. 0 in the first
    /// step after a start or a change of stage, where a method has nothing yet to compare with.
    double error_um = 0.0;
    double largest_displacement_um = 0.0;
    int rejected = 0;  ///< attempts with larger steps before this one
    int linear_iterations = 0;
    double force_rms_nN = 0.0;             ///< RMS over nodes of F at the start of the step
    double force_sum_nN = 0.0;             ///< |sum of F| there
    double dissipation_nN_um_per_s = 0.0;  ///< v . Gamma v
    double drive_power_nN_um_per_s =
        0.0;                         ///< power put in by the moving wall and the volume controller
    std::optional<Trouble> trouble;  ///< if not accepted
};

/// What forward_euler does with the largest stable step that it estimates.
enum class StableStep {
    refuse,  ///< a larger step ends the run
    follow,  ///< the step is a fraction of it, at most dt_max
    ignore,  ///< no estimate: for those who want to see what happens
};

struct MethodParameters {
    double dt_s = 0.0;  ///< fixed step, or the first step of an adaptive method
    double dt_max_s = 1.0;
    double dt_min_s = 1e-6;
    double tolerance_um = 0.0;            ///< local error per step; 0: fixed steps
    double displacement_bound_um = 0.15;  ///< largest displacement of a node per step
    double linear_tolerance = 1e-3;
    StableStep stable_step = StableStep::refuse;
    Loc loc;
};

/// Advances the equation of motion by one step.
class Method {
  public:
    virtual ~Method() = default;
    /// One accepted step, not beyond limit_s; or a failure, with the state untouched.
    /// freeze_volume_integral: the integral of (13) does not advance (while a wall acts).
    virtual StepOutcome advance(System& system, State& state, double limit_s,
                                bool freeze_volume_integral) = 0;
};

/// A row of the table of methods.
struct MethodRow {
    std::string_view name;    ///< in scenes: method.name
    int order;                ///< of the error in time; 0: none, its motion is not a motion in time
    int estimate_order;       ///< power of dt by which its error estimate grows; 0: fixed steps
    int stages;               ///< force evaluations of a step; 0: as many as its length asks for
    bool needs_stiffness;     ///< solves with (Gamma + dt K)
    bool holds_exact_volume;  ///< can keep V = V* (controller = "exact")
    bool moves_probe;         ///< the probe of an indentation is one of its unknowns
    std::string_view description;
    std::unique_ptr<Method> (*make)(const MethodParameters&);

    /// Chooses its steps by its error estimate.
    [[nodiscard]] bool adaptive() const { return estimate_order > 0; }
    /// Its states are states of the motion at their times; else only its end means something.
    [[nodiscard]] bool moves_in_time() const { return order > 0; }
};
[[nodiscard]] std::span<const MethodRow> all_methods();
[[nodiscard]] const MethodRow* find_method(std::string_view name);

}  // namespace spheroscope
