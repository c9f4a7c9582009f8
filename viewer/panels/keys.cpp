#include "viewer/panels/panel.hpp"

#include <imgui.h>

#include <string>

namespace spheroscope::viewer {

void draw_keys(PanelContext& panel) {
    static_cast<void>(panel);
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
    for (const KeyRow& row : all_keys()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(std::string(row.keys).c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(std::string(row.meaning).c_str());
    }
    ImGui::EndTable();
    ImGui::TextDisabled("a drag turns the spheroid, a click picks");
}

}  // namespace spheroscope::viewer
