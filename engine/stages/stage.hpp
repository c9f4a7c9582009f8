#pragma once

#include "engine/measures/totals.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solve/system.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace spheroscope {

/// How a stage ended.
enum class StageEnd { none, done, rest, stationary, cap };
[[nodiscard]] std::string_view name_of(StageEnd end);
[[nodiscard]] std::string_view name_of(scene::StageKind kind);

/// What a stage remembers between steps; a part of every checkpoint.
struct StageMemory {
    double start_s = 0.0;
    double touching_wall_um = 0.0;  ///< where the wall first touched; the release goes back to it
    std::vector<double> samples;    ///< rows of a stage's own table, flat
};

/// What a stage may see and change.
struct StageContext {
    System& system;
    State& state;
    StageMemory& memory;
};

/// A part of a run that ends on a condition. Model time goes on from stage to stage.
class Stage {
  public:
    explicit Stage(const scene::Stage& parameters) : parameters_(parameters) {}
    virtual ~Stage() = default;

    /// Called once, when the stage begins.
    virtual void begin(StageContext& context) const { static_cast<void>(context); }
    /// Model time that no step may pass.
    [[nodiscard]] virtual double latest_end_s(const StageContext& context) const {
        return context.memory.start_s + parameters_.duration_s;
    }
    /// After every step. The system holds an evaluation of that step, at its start or its end.
    [[nodiscard]] virtual StageEnd after_step(StageContext& context) const;
    /// After every measurement of the state as it is now.
    [[nodiscard]] virtual StageEnd after_measure(StageContext& context,
                                                 const Totals& totals) const {
        static_cast<void>(context), static_cast<void>(totals);
        return StageEnd::none;
    }
    /// Called once, when the stage is over.
    virtual void end(StageContext& context) const { static_cast<void>(context); }
    /// 0..1, or NaN where the end is not known beforehand.
    [[nodiscard]] virtual double progress(const StageContext& context) const;

    [[nodiscard]] const scene::Stage& parameters() const { return parameters_; }

  protected:
    scene::Stage parameters_;
};

/// The stage's class for any kind but `anneal`, which moves beads and not cells.
[[nodiscard]] std::unique_ptr<Stage> make_stage(const scene::Stage& parameters);

}  // namespace spheroscope
