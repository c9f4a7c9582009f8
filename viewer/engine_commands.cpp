#include "viewer/engine_commands.hpp"

#include "viewer/live_run.hpp"

#include <optional>

namespace spheroscope::viewer {

bool command_engine(PanelModel& model, LiveRun* live, Action action) {
    if (live == nullptr || live->is_over()) {
        const bool is_for_engine = action == Action::single_step || action == Action::until_event ||
                                   action == Action::look_into_step;
        if (is_for_engine)
            model.message = live == nullptr ? "a stored run has no engine that could make a step"
                                            : "the run is over";
        return is_for_engine;
    }
    LiveChannel& channel = live->channel();
    switch (action) {
    case Action::toggle_playing:
        if (!model.shows_engine()) return false;  // frames are played
        channel.is_paused() ? channel.play() : channel.pause();
        model.follow_engine();
        return true;
    case Action::single_step:
        channel.step();
        model.follow_engine();
        return true;
    case Action::until_event: {
        Watched watched;
        if (model.selection) watched = {model.selection->cell, model.selection->other_cell};
        channel.run_until_event(watched);
        model.follow_engine();
        return true;
    }
    case Action::look_into_step: {
        std::optional<NodeOfCell> node;
        if (model.selection) node = {model.selection->cell, model.selection->node};
        channel.look_into_step(node);
        model.follow_engine();
        return true;
    }
    case Action::back:
        if (model.shows_engine()) channel.pause();  // what is looked back at would move on
        return false;
    default: return false;
    }
}

}  // namespace spheroscope::viewer
