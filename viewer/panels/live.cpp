// The running engine: pause, single steps, on to the next event, and parameters that change with
// the next step.

#include "engine/base/counted.hpp"
#include "viewer/live_run.hpp"
#include "viewer/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>

namespace spheroscope::viewer {
namespace {

/// A slider over a factor of four to either side; where it is let go becomes an order.
void change_parameter(LiveRun& live, LiveLooks& state, const ChangeableRow& row, double now) {
    const std::string key(row.key);
    const bool is_held = state.dragged_key == key;
    double shown = is_held ? state.dragged_value : now;
    const double lowest = now / 4.0, highest = now * 4.0;
    const std::string label = fmt::format("{}##{}", row.symbol, row.key);
    const std::string format = "%.4g " + std::string(scene::engine_unit(row.dimension));
    ImGui::SetNextItemWidth(-110.0F);
    ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, &shown, &lowest, &highest,
                        format.c_str(),
                        ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat);
    if (ImGui::IsItemActive()) {
        state.dragged_key = key;
        state.dragged_value = shown;
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) live.channel().order({0.0, key, {shown}});
    if (ImGui::IsItemDeactivated()) state.dragged_key.clear();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", key.c_str());
}

void show_state(const PanelContext& panel, const Pace& pace) {
    if (panel.snapshot == nullptr) return;
    ImGui::TextDisabled("%s", fmt::format("t = {:.4g} s, step {}, dt = {:.3g} s",
                                          panel.snapshot->time_s, panel.snapshot->diagnostics.steps,
                                          panel.snapshot->diagnostics.dt_s)
                                  .c_str());
    if (std::isfinite(pace.recent()))
        ImGui::TextDisabled("%s",
                            fmt::format("{:.3g} s of model time a second", pace.recent()).c_str());
}

}  // namespace

void draw_live(PanelContext& panel) {
    LiveRun& live = *panel.live;
    LiveChannel& channel = live.channel();
    LiveLooks& state = *panel.model.live;
    if (live.is_over()) {
        ImGui::TextUnformatted("the run is over");
    } else {
        if (ImGui::Button(channel.is_paused() ? "go on" : "pause", {70.0F, 0.0F})) {
            panel.model.follow_engine();
            panel.act(Action::toggle_playing);
        }
        ImGui::SameLine();
        if (ImGui::Button("step")) panel.act(Action::single_step);
        ImGui::SameLine();
        if (ImGui::Button("to event")) panel.act(Action::until_event);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip(
                "until a contact forms, breaks, or its force along the line of centres "
                "changes sign,\nor a stage begins; of the picked contact or cell, "
                "or of all");
        ImGui::SameLine();
        if (ImGui::Button("newest")) panel.model.follow_engine();
    }
    show_state(panel, channel.pace());
    if (panel.model.shows_engine() && state.looks_back > 0)
        ImGui::TextDisabled("%d of %d kept states back", state.looks_back, state.n_looks);
    if (live.is_over()) return;
    const scene::Scene& now = live.scene_now();
    for (const ChangeableRow& row : all_changeable())
        if (row.of == ChangeableRow::Of::engine && row.is_in(now))
            change_parameter(live, state, row, row.get(now)[0]);
    const std::vector<Change> changes = channel.changes();
    if (!changes.empty())
        ImGui::TextDisabled("%s",
                            fmt::format("{} so far, the last at t = {:.4g} s",
                                        counted(changes.size(), "change"), changes.back().time_s)
                                .c_str());
}

}  // namespace spheroscope::viewer
