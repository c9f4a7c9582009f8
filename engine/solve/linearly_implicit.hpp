#pragma once

#include "engine/solve/implicit_volume.hpp"
#include "engine/solve/method.hpp"
#include "engine/solve/probe_coupling.hpp"

#include <limits>
#include <vector>

namespace spheroscope {

/// (Gamma + dt K) v = F; see linearly_implicit.cpp.
class LinearlyImplicit : public Method {
  public:
    explicit LinearlyImplicit(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) final;

  protected:
    /// What bounds the next step beside error, displacement and dt_max, after this accepted one.
    [[nodiscard]] virtual double longest_next_step_s(System& system,
                                                     const StepOutcome& outcome) const {
        static_cast<void>(system), static_cast<void>(outcome);
        return std::numeric_limits<double>::infinity();
    }

    MethodParameters parameters_;

  private:
    ImplicitVolume volume_;
    ProbeCoupling probe_;
    std::vector<Vec3> v_, b_;
    std::vector<double> integral_rate_;  // [cells]
};

[[nodiscard]] std::unique_ptr<Method> make_linearly_implicit(const MethodParameters& parameters);

}  // namespace spheroscope
