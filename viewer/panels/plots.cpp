#include "viewer/panels/panel.hpp"
#include "viewer/panels/plot.hpp"

#include <imgui.h>

#include <array>
#include <string>

namespace spheroscope::viewer {
namespace {

/// A number of the aggregate over time; seeding, which has no time, is left out.
Plot over_time(const PanelContext& panel, Series series) {
    const SeriesRow& row = row_of(series);
    Plot plot;
    plot.title = std::string(row.name) + (row.unit.empty() ? "" : ", " + std::string(row.unit));
    plot.x_label = "over t, s";
    for (const FrameSummary& frame : panel.summaries) {
        if (!has_mechanics(frame.stage_name)) continue;
        plot.curve.x.push_back(static_cast<float>(frame.time_s));
        plot.curve.y.push_back(static_cast<float>(row.value(frame)));
    }
    if (panel.snapshot != nullptr) plot.now = static_cast<float>(panel.snapshot->time_s);
    return plot;
}

}  // namespace

void draw_plots(PanelContext& panel) {
    std::array<Plot, 6> plots{
        Plot{"σ^h, Pa", "over r / R_th", PlotKind::steps, panel.radial_stress},
        Plot{"P(f)", "over f = |F| / <|F|>", PlotKind::bars, panel.force_distribution},
        over_time(panel, Series::coordination),
        over_time(panel, Series::volume_error),
        over_time(panel, Series::time_step),
        over_time(panel, Series::residual_force),
    };
    plots[1].from_zero = true;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float width = room.x / static_cast<float>(plots.size()) - 8.0F;
    if (width < 90.0F || room.y < 60.0F) return;  // no room for numbers beside a curve
    for (std::size_t k = 0; k < plots.size(); ++k) {
        if (k > 0) ImGui::SameLine();
        draw_plot(plots[k], width, room.y - 4.0F, panel.small_font);
    }
}

}  // namespace spheroscope::viewer
