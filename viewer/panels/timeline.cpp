#include "viewer/panels/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>

namespace spheroscope::viewer {
namespace {

void button(PanelContext& panel, const char* label, const char* hint, Action action) {
    if (ImGui::Button(label, {32.0F, 0.0F})) panel.act(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", hint);
    ImGui::SameLine();
}

void choose_speed(Playback& playback) {
    static constexpr std::array<double, 7> speeds{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0};
    ImGui::SetNextItemWidth(84.0F);
    if (!ImGui::BeginCombo("##speed", fmt::format("× {}", playback.speed()).c_str())) return;
    for (const double speed : speeds)
        if (ImGui::Selectable(fmt::format("× {}", speed).c_str(), speed == playback.speed()))
            playback.set_speed(speed);
    ImGui::EndCombo();
}

}  // namespace

void draw_timeline(PanelContext& panel) {
    Playback& playback = panel.model.playback;
    if (playback.n_frames() == 0) {
        ImGui::TextDisabled("no frame yet");
        return;
    }
    button(panel, "|◀", "first frame (Home)", Action::first);
    button(panel, "◀", "one frame back (←; with Shift ten)", Action::back);
    button(panel, playback.is_playing() ? "||" : "▶", "play, pause (Space)",
           Action::toggle_playing);
    button(panel, "▶▶", "one frame on (→; with Shift ten)", Action::forward);
    button(panel, "▶|", "last frame (End)", Action::last);
    choose_speed(playback);
    ImGui::SameLine();

    std::array<char, 32>& typed = panel.model.typed_time;
    ImGui::SetNextItemWidth(84.0F);
    if (ImGui::InputTextWithHint("##time", "go to time", typed.data(), typed.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        panel.model.go_to_typed_time(typed.data());
        if (panel.model.message.empty()) typed.fill('\0');
    }
    ImGui::SameLine();
    int frame = playback.frame();
    ImGui::SetNextItemWidth(-290.0F);
    if (ImGui::SliderInt("##frame", &frame, 0, playback.n_frames() - 1, "",
                         ImGuiSliderFlags_AlwaysClamp))
        playback.go_to(frame);
    ImGui::SameLine();
    const double time_s = playback.time_s()[static_cast<std::size_t>(playback.frame())];
    const std::string stage =
        panel.snapshot != nullptr ? std::string(panel.snapshot->stage_name) : std::string();
    ImGui::TextUnformatted(fmt::format("{} / {}   t = {:.2f} s   {}", playback.frame(),
                                       playback.n_frames() - 1, time_s, stage)
                               .c_str());
}

}  // namespace spheroscope::viewer
