#include "viewer/layout.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>

namespace spheroscope::viewer {
namespace {

constexpr float k_right_px = 372.0F, k_below_px = 232.0F, k_message_px = 64.0F;

void draw_right_panels(PanelContext& panel, float height_px) {
    ImGui::BeginChild("right", {0.0F, std::max(1.0F, height_px)}, true);
    for (const PanelRow& row : all_panels()) {
        if (row.side != Side::right || (row.needs_engine && panel.live == nullptr)) continue;
        if (row.opens_for(panel.model)) ImGui::SetNextItemOpen(true);
        const ImGuiTreeNodeFlags flags =
            row.opened ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
        if (ImGui::CollapsingHeader(std::string(row.title).c_str(), flags)) row.draw(panel);
    }
    ImGui::EndChild();
}

void draw_message(const PanelContext& panel) {
    ImGui::BeginChild("message", {0.0F, k_message_px}, true);
    ImGui::PushFont(panel.small_font);
    if (!panel.status.empty()) ImGui::TextWrapped("%s", panel.status.c_str());
    if (!panel.model.message.empty()) ImGui::TextWrapped("%s", panel.model.message.c_str());
    ImGui::PopFont();
    ImGui::EndChild();
}

}  // namespace

void draw_layout(PanelContext& panel) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float left = room.x - k_right_px - 8.0F, above = room.y - k_below_px - 8.0F;
    ImGui::BeginChild("picture side", {std::max(1.0F, left), std::max(1.0F, above)}, true,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_picture(panel, left - 24.0F, above - 20.0F);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginGroup();
    draw_right_panels(panel, above - k_message_px - 6.0F);
    draw_message(panel);
    ImGui::EndGroup();
    ImGui::BeginChild("below", {0.0F, 0.0F}, true, ImGuiWindowFlags_NoScrollbar);
    for (const PanelRow& row : all_panels())
        if (row.side == Side::below) row.draw(panel);
    ImGui::EndChild();
    ImGui::End();
}

}  // namespace spheroscope::viewer
