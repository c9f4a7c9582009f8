#include "viewer/panels/panel.hpp"

#include <imgui.h>

namespace spheroscope::viewer {

void draw_table(const std::vector<TableRow>& rows, float first_px) {
    if (!ImGui::BeginTable("table", 3, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, first_px);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("unit", ImGuiTableColumnFlags_WidthFixed, 44.0F);
    for (const TableRow& row : rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (row.value.empty()) {
            ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, IM_COL32(228, 232, 240, 255));
            ImGui::TextUnformatted(row.what.c_str());
            continue;
        }
        ImGui::TextUnformatted(row.what.c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.value.c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.unit.c_str());
    }
    ImGui::EndTable();
}

void draw_selection(PanelContext& panel) {
    if (!panel.model.selection || panel.snapshot == nullptr) {
        ImGui::TextDisabled("a click on the picture picks a node, its triangle,\n"
                            "its cell, and the contact there");
        return;
    }
    const std::vector<TableRow> rows = describe(*panel.snapshot, *panel.model.selection);
    draw_table(rows);
    if (ImGui::Button("copy as CSV")) panel.act(Action::copy_table);
    ImGui::SameLine();
    const bool shows_node =
        panel.model.opened && std::holds_alternative<NodeOfCell>(*panel.model.opened);
    if (ImGui::Button(shows_node ? "back to all cells" : "forces on the node"))
        panel.act(Action::open_node);
    ImGui::SameLine();
    if (ImGui::Button("forget")) panel.model.selection.reset();
}

}  // namespace spheroscope::viewer
