#pragma once

#include "engine/run/changes.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/run/step_anatomy.hpp"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope {

/// What somebody who watches a run can do: see every frame and looks in between, make it wait,
/// change parameters between two steps. All functions are called in the engine's thread, and the
/// state has the same bits whether somebody watches or not.
class LiveControl {
  public:
    virtual ~LiveControl() = default;

    /// Before anything else.
    virtual void begin(std::shared_ptr<const RunHeader> header) = 0;
    /// A frame that was handed to the store as well.
    virtual void frame(SnapshotPtr frame) = 0;
    /// Between two steps; may wait, which is a pause, until it is over, a question is there, or
    /// `stop` becomes true. False: the run is to stop, with a checkpoint.
    [[nodiscard]] virtual bool go_on(const std::atomic<bool>& stop) = 0;
    /// Asked after go_on(): whether the next step is to be taken apart before it is made. The
    /// answer goes to anatomy(), or the reason why there is none to refused_question(); then
    /// go_on() is asked again.
    struct Question {
        std::optional<NodeOfCell> node;  ///< the forces on it are wanted, too
    };
    [[nodiscard]] virtual std::optional<Question> take_question() = 0;
    virtual void anatomy(std::shared_ptr<const StepAnatomy> answer) = 0;
    virtual void refused_question(const std::string& reason) = 0;
    /// Whether a look at the state as it is now is welcome.
    [[nodiscard]] virtual bool wants_look() = 0;
    /// A snapshot that is no frame: its number is -1.
    virtual void look(SnapshotPtr now) = 0;
    /// Changes that are to take effect with the next step; their times are filled in by the engine.
    [[nodiscard]] virtual std::vector<Change> take_changes() = 0;
    /// A change took effect, or was refused for this reason.
    virtual void changed(const Change& change) = 0;
    virtual void refused(const Change& change, const std::string& reason) = 0;
};

}  // namespace spheroscope
