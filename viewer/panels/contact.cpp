// The contact that is open: its numbers in the frame on show, and its events.

#include "engine/base/counted.hpp"
#include "engine/inspect/contact_history.hpp"
#include "viewer/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::viewer {
namespace {

std::string number_text(double value) {
    return std::isnan(value) ? "no contact" : fmt::format("{:.4g}", value);
}

void draw_numbers(const inspect::ContactSummary& row) {
    std::vector<TableRow> rows;
    for (const inspect::Quantity& quantity : inspect::all_quantities())
        rows.push_back({std::string(quantity.label), number_text(value_of(quantity, row)),
                        std::string(quantity.unit)});
    draw_table(rows, 190.0F);
}

void draw_events(PanelContext& panel) {
    const std::vector<inspect::ContactEvent> events = inspect::find_events(*panel.contact_history);
    if (ImGui::ArrowButton("event before", ImGuiDir_Left)) panel.act(Action::event_before);
    ImGui::SameLine();
    if (ImGui::ArrowButton("event after", ImGuiDir_Right)) panel.act(Action::event_after);
    ImGui::SameLine();
    if (events.empty()) {
        ImGui::TextDisabled("no events so far");
        return;
    }
    ImGui::TextDisabled("%s",
                        (counted(events.size(), "event") + "; a click leads to its frame").c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("it forms, breaks, or its normal force (along the contact's normal)\n"
                          "changes sign from one frame to the next");
    for (const inspect::ContactEvent& event : events) {
        const bool is_shown = event.frame == panel.model.playback.frame();
        const std::string text =
            fmt::format("{:.4g} s: {}, {:.3g} to {:.3g} nN##{}", event.time_s, name_of(event.kind),
                        event.force_before_nN, event.force_after_nN, event.frame);
        if (ImGui::Selectable(text.c_str(), is_shown)) panel.model.playback.go_to(event.frame);
    }
}

}  // namespace

bool contact_is_new(const PanelModel& model) {
    return model.opened_is_new && contact_of(model.opened).has_value();
}

void draw_contact(PanelContext& panel) {
    PanelModel& model = panel.model;
    if (contact_is_new(model)) model.opened_is_new = false;
    const std::optional<inspect::ContactKey> contact = contact_of(model.opened);
    const bool can_open = model.selection && model.selection->other_cell >= 0;
    ImGui::BeginDisabled(!contact && !can_open);
    if (ImGui::Button(contact ? "back to all cells" : "open the picked contact"))
        panel.act(Action::open_contact);
    ImGui::EndDisabled();
    if (!contact || panel.contact_history == nullptr) return;
    const std::vector<inspect::ContactSummary>& history = *panel.contact_history;
    ImGui::SameLine();
    ImGui::TextDisabled(
        "%s",
        fmt::format("{}, {} read", contact->text(), counted(history.size(), "frame")).c_str());
    const int frame = panel.snapshot == nullptr ? -1 : panel.snapshot->frame;
    const auto row = std::find_if(history.begin(), history.end(),
                                  [&](const auto& summary) { return summary.frame == frame; });
    if (row != history.end()) draw_numbers(*row);
    draw_events(panel);
}

}  // namespace spheroscope::viewer
