// What an engine does for somebody who watches it: looks, changes, a step taken apart. Only a
// change that was asked for touches the run.

#include "engine/run/engine.hpp"
#include "engine/stages/choices.hpp"

#include <tuple>

namespace spheroscope {

void Engine::show_look(double progress) {
    if (sinks_->live == nullptr || !sinks_->live->wants_look()) return;
    // A measurement begins a new interval of the power balance; a look is none.
    const auto before = std::tuple(run_.has_energy, run_.energy_fJ, run_.dissipated_fJ,
                                   run_.driven_fJ, run_.diagnostics);
    const Totals totals = measure();
    sinks_->live->look(snapshot_of(totals, progress));
    std::tie(run_.has_energy, run_.energy_fJ, run_.dissipated_fJ, run_.driven_fJ,
             run_.diagnostics) = before;
}

void Engine::make_change(const Change& change) {
    apply_change(scene_, change);
    std::vector<Change> made = changes_made_ ? *changes_made_ : std::vector<Change>();
    made.push_back(change);
    changes_made_ = std::make_shared<const std::vector<Change>>(std::move(made));
}

void Engine::apply_changes() {
    bool has_changed = false;
    const auto apply = [&](const Change& change) {
        make_change(change);
        if (find_changeable(change.key)->of == ChangeableRow::Of::engine) has_changed = true;
    };
    while (n_changes_applied_ < options_.changes.size() &&
           options_.changes[n_changes_applied_].time_s <= run_.state.time_s)
        apply(options_.changes[n_changes_applied_++]);
    if (sinks_->live != nullptr)
        for (Change& change : sinks_->live->take_changes()) {
            change.time_s = run_.state.time_s;
            try {
                apply(change);
            } catch (const Error& error) {
                sinks_->live->refused(change, error.what());
                continue;
            }
            if (sinks_->changed) sinks_->changed(change);
            sinks_->live->changed(change);
        }
    if (!has_changed) return;
    // The state is untouched: only what acts on it is made anew.
    use_mesh(system_->model().n_nodes());
    method_ = chosen_method(scene_).make(method_parameters(scene_));
    run_.state.fastest_rate_per_s = 0.0;  // explicit methods find their bound anew
}

bool Engine::watcher_goes_on(const std::function<double()>& next_limit_s) {
    if (sinks_->live == nullptr) return true;
    LiveControl& live = *sinks_->live;
    while (live.go_on(*stop_)) {
        const std::optional<LiveControl::Question> question = live.take_question();
        if (!question) return true;
        if (!next_limit_s) {
            live.refused_question(
                "seeding moves beads: there is no step of the cells to look into");
            continue;
        }
        apply_changes();  // the step would be made with them
        try {
            live.anatomy(std::make_shared<const StepAnatomy>(
                take_apart(*system_, *method_, run_.state, next_limit_s(), run_.state.wall.acts(),
                           question->node)));
        } catch (const Error& error) {
            live.refused_question(error.what());
        }
    }
    return false;
}

}  // namespace spheroscope
