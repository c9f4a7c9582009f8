// The health strip: a number of the frame on show for each row, and a red mark on the row's line
// for each frame where it was beyond its limit. A click on a mark goes to that frame, and picks the
// contact that is to blame, where the row is about contacts.

#include "viewer/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::viewer {
namespace {

constexpr ImU32 k_red = IM_COL32(196, 40, 40, 255), k_line = IM_COL32(190, 196, 206, 255);

std::string text_of(const SeriesRow& row, double value) {
    if (std::isnan(value)) return "undefined";
    return fmt::format("{:.3g}{}{}", value, row.unit.empty() ? "" : " ", row.unit);
}

/// A line with a mark for each bad frame; a click goes to the one that is nearest.
void draw_marks(PanelContext& panel, const SeriesRow& row, float width) {
    const std::vector<int> bad = bad_frames(row, panel.summaries);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float last = static_cast<float>(std::max(1, panel.model.playback.n_frames() - 1));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({corner.x, corner.y + 5.0F}, {corner.x + width, corner.y + 5.0F}, k_line, 2.0F);
    const auto x_of = [&](int frame) {
        return corner.x + width * static_cast<float>(frame) / last;
    };
    for (const int frame : bad)
        list.AddRectFilled({x_of(frame) - 1.5F, corner.y}, {x_of(frame) + 1.5F, corner.y + 10.0F},
                           k_red);
    ImGui::InvisibleButton("marks", {width, 10.0F});
    if (bad.empty() || !ImGui::IsItemHovered()) return;
    const float mouse = ImGui::GetIO().MousePos.x;
    const int nearest = *std::min_element(bad.begin(), bad.end(), [&](int a, int b) {
        return std::abs(x_of(a) - mouse) < std::abs(x_of(b) - mouse);
    });
    ImGui::SetTooltip("frame %d: %s", nearest, std::string(row.meaning).c_str());
    if (ImGui::IsItemClicked()) panel.model.go_to_blame(nearest, row);
}

}  // namespace

void draw_health(PanelContext& panel) {
    if (panel.snapshot != nullptr) panel.model.pick_blamed(*panel.snapshot);
    const auto n = all_series().size();
    const float width = ImGui::GetContentRegionAvail().x;
    const float cell = width / static_cast<float>(n + 1) - 6.0F;
    if (cell < 20.0F) return;
    ImGui::PushFont(panel.small_font);
    ImGui::BeginGroup();
    ImGui::TextDisabled("step");
    if (panel.snapshot != nullptr)
        ImGui::Text("%lld", static_cast<long long>(panel.snapshot->diagnostics.steps));
    ImGui::EndGroup();
    for (const SeriesRow& row : all_series()) {
        ImGui::SameLine(0.0F, 0.0F);
        const auto k = static_cast<float>(&row - all_series().data());
        ImGui::SetCursorPosX(12.0F + (k + 1.0F) * (cell + 6.0F) - cell * 0.35F);
        ImGui::PushID(static_cast<int>(k));
        ImGui::BeginGroup();
        ImGui::TextDisabled("%s", std::string(row.name).c_str());
        const double value =
            panel.snapshot == nullptr ? std::nan("") : row.value(summary_of(*panel.snapshot));
        const std::string text = text_of(row, value);
        if (is_bad(row, value))
            ImGui::TextColored({0.77F, 0.16F, 0.16F, 1.0F}, "%s", text.c_str());
        else
            ImGui::TextUnformatted(text.c_str());
        if (!row.meaning.empty()) draw_marks(panel, row, cell - 8.0F);
        ImGui::EndGroup();
        ImGui::PopID();
    }
    ImGui::PopFont();
}

}  // namespace spheroscope::viewer
