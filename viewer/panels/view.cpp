#include "engine/scene/limits.hpp"
#include "viewer/panels/panel.hpp"

#include <imgui.h>

#include <array>
#include <string>
#include <string_view>

namespace spheroscope::viewer {
namespace {

const Field* field_of(const PanelContext& panel, const std::string& name) {
    for (const Field* field : panel.header.fields)
        if (field->name == name) return field;
    return nullptr;
}

void choose_field(const PanelContext& panel, ViewSettings& view) {
    const Field* now = field_of(panel, view.picture.field);
    const auto label = [](const Field* field) {
        return field == nullptr ? std::string("plain cells")
                                : std::string(field->symbol) + "   " + std::string(field->name);
    };
    if (!ImGui::BeginCombo("field", label(now).c_str(), ImGuiComboFlags_HeightLarge)) return;
    std::vector<const Field*> choices = panel.header.fields;
    choices.push_back(nullptr);
    for (const Field* field : choices) {
        if (ImGui::Selectable(label(field).c_str(), field == now)) {
            view.picture.field = field == nullptr ? "" : std::string(field->name);
            // A range that was given for another field means nothing here.
            if (field != now && view.picture.range == "given") view.picture.range = "run";
        }
        if (field != nullptr && ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", std::string(field->description).c_str());
    }
    ImGui::EndCombo();
}

/// Two numbers, taken with Enter: what is typed so far is not what is meant (1 and 12 of 120).
bool type_two(const char* label, std::array<double, 2>& numbers, const char* format) {
    const bool is_typed = ImGui::InputScalarN(
        label, ImGuiDataType_Double, numbers.data(), 2, nullptr, nullptr, format,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CharsScientific);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Enter takes what is typed");
    return is_typed;
}

void choose_range(const PanelContext& panel, ViewSettings& view) {
    static constexpr std::array<const char*, 3> words{"run", "frame", "given"};
    static constexpr std::array<const char*, 3> labels{"whole run", "this frame", "given"};
    scene::Picture& p = view.picture;
    for (std::size_t k = 0; k < words.size(); ++k) {
        if (k > 0) ImGui::SameLine();
        if (!ImGui::RadioButton(labels[k], p.range == words[k]) || p.range == words[k]) continue;
        p.range = words[k];
        // The given range begins as the one that is on show.
        if (p.range == "given" && panel.shown != nullptr && panel.shown->request.view.range)
            p.given_range = {panel.shown->request.view.range->low,
                             panel.shown->request.view.range->high};
        if (!(p.given_range[0] < p.given_range[1])) p.given_range = {-100.0, 100.0};
    }
    if (p.range != "given") return;
    std::array<double, 2> typed = p.given_range;
    ImGui::SetNextItemWidth(-70.0F);
    const Field* field = field_of(panel, p.field);
    const std::string label = field == nullptr ? "range" : std::string(field->shown_unit);
    if (!type_two(label.c_str(), typed, "%.6g") || typed == p.given_range) return;
    panel.model.message = scene::problem_of_range(typed);
    if (panel.model.message.empty()) p.given_range = typed;
}

/// Takes a typed number where a scene could have it too; else says why not, and it stays what it
/// was.
void take(PanelContext& panel, double& member, double typed, std::string_view key) {
    if (typed == member) return;
    panel.model.message = scene::problem_of_number(key, typed);
    if (panel.model.message.empty()) member = typed;
}

/// The slider goes as far as pictures are of use; more can be typed, as scenes can have it.
void choose_exploded(PanelContext& panel, scene::Picture& p) {
    constexpr double k_left = 0.0, k_right = 2.0;
    double exploded = p.exploded;
    ImGui::SetNextItemWidth(150.0F);
    if (ImGui::SliderScalar("pulled apart", ImGuiDataType_Double, &exploded, &k_left, &k_right,
                            "%.2f"))
        take(panel, p.exploded, exploded, "picture.exploded");
}

void choose_angles(PanelContext& panel, scene::Picture& p) {
    std::array<double, 2> angles{p.azimuth_deg, p.elevation_deg};
    ImGui::SetNextItemWidth(150.0F);
    if (!type_two("##angles", angles, "%.1f°")) return;
    take(panel, p.azimuth_deg, angles[0], "picture.azimuth");
    take(panel, p.elevation_deg, angles[1], "picture.elevation");
}

}  // namespace

void draw_view(PanelContext& panel) {
    PanelModel& model = panel.model;
    ViewSettings view = model.view.now();
    ImGui::PushItemWidth(-70.0F);
    if (ImGui::BeginCombo("preset", view.picture.name.c_str())) {
        for (std::size_t k = 0; k < model.presets().size(); ++k)
            if (ImGui::Selectable(model.presets()[k].name.c_str(),
                                  model.presets()[k].name == view.picture.name))
                view.picture = model.presets()[k];
        ImGui::EndCombo();
    }
    choose_field(panel, view);
    ImGui::PopItemWidth();
    choose_range(panel, view);
    ImGui::Checkbox("cutaway", &view.picture.cutaway);
    ImGui::SameLine();
    ImGui::Checkbox("force network", &view.picture.network);
    if (render::holds_stress_axes(panel.header)) {
        ImGui::SameLine();
        ImGui::Checkbox("stress axes", &view.picture.stress_axes);
    }
    choose_exploded(panel, view.picture);
    choose_angles(panel, view.picture);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##look", "look from ...")) {
        for (const Direction& direction : directions())
            if (ImGui::Selectable(std::string(direction.name).c_str())) {
                view.picture.azimuth_deg = direction.azimuth_deg;
                view.picture.elevation_deg = direction.elevation_deg;
            }
        ImGui::EndCombo();
    }
    if (!model.view.is_dragging()) model.change_view(view);

    ImGui::BeginDisabled(!model.view.can_undo());
    if (ImGui::Button("undo")) panel.act(Action::undo);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!model.view.can_redo());
    if (ImGui::Button("redo")) panel.act(Action::redo);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("copy as scene")) panel.act(Action::copy_view);
    ImGui::SameLine();
    if (ImGui::Button("save picture")) panel.act(Action::save_picture);
}

}  // namespace spheroscope::viewer
