// The next step of a paused engine, taken apart: before and after each term, and the solver's
// residual.

#include "viewer/live_run.hpp"
#include "viewer/model/step_moments.hpp"
#include "viewer/panels/panel.hpp"
#include "viewer/panels/plot.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::viewer {
namespace {

void draw_residual(const SolveHistory& solve, ImFont* font) {
    Plot plot;
    plot.title = "log10 of |F - A v| / |F|";
    plot.x_label = "over iterations";
    for (std::size_t k = 0; k < solve.residual.size(); ++k) {
        plot.curve.x.push_back(static_cast<float>(k));
        plot.curve.y.push_back(static_cast<float>(std::log10(solve.residual[k])));
    }
    draw_plot(plot, ImGui::GetContentRegionAvail().x, 120.0F, font);
}

}  // namespace

bool step_is_new(const PanelModel& model) { return model.live && model.live->anatomy_is_new; }

void draw_step(PanelContext& panel) {
    LiveLooks& state = *panel.model.live;
    state.anatomy_is_new = false;
    if (!panel.live->is_over() && ImGui::Button("look into the next step"))
        panel.act(Action::look_into_step);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("pauses; the forces on the picked node are shown, too.\n"
                          "The step is not made by this");
    if (state.anatomy == nullptr) return;
    const std::vector<StepMoment> moments = moments_of(*state.anatomy);
    const int last = static_cast<int>(moments.size()) - 1;
    ImGui::PushButtonRepeat(true);
    if (ImGui::ArrowButton("before", ImGuiDir_Left)) --state.moment;
    ImGui::SameLine();
    if (ImGui::ArrowButton("after", ImGuiDir_Right)) ++state.moment;
    ImGui::PopButtonRepeat();
    state.moment = std::clamp(state.moment, 0, last);
    ImGui::SameLine();
    ImGui::TextDisabled("%s", fmt::format("{} of {}, t = {:.4g} s", state.moment + 1, last + 1,
                                          state.anatomy->time_s)
                                  .c_str());
    const StepMoment& moment = moments[static_cast<std::size_t>(state.moment)];
    ImGui::TextUnformatted(moment.what.c_str());
    const bool has_vectors =
        std::any_of(moment.rows.begin(), moment.rows.end(),
                    [](const TableRow& row) { return row.value.starts_with('('); });
    draw_table(moment.rows, has_vectors ? 84.0F : 190.0F);
    if (moment.solve != nullptr && moment.solve->residual.size() > 1)
        draw_residual(*moment.solve, panel.small_font);
}

}  // namespace spheroscope::viewer
