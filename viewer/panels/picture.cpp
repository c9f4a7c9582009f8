// The picture: drags turn the view, a click picks what is under the pointer, which gets a ring.

#include "engine/run/exploded.hpp"
#include "viewer/panels/panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace spheroscope::viewer {
namespace {

/// The pointer may tremble so far during a click.
constexpr float k_click_px = 4.0F;

struct Shown {
    ImVec2 corner;    // of the picture on the screen
    float scale = 1;  // screen pixels for each of the picture
};

void pick_at(PanelContext& panel, const Shown& shown, ImVec2 mouse) {
    const render::Camera& camera = panel.shown->camera;
    const double x = double{(mouse.x - shown.corner.x) / shown.scale};
    const double y = double{(mouse.y - shown.corner.y) / shown.scale};
    Sight sight;
    sight.origin_um = camera.focal_um +
                      camera.right * ((x - camera.centre_x_px) / camera.px_per_um) +
                      camera.up * ((camera.centre_y_px - y) / camera.px_per_um);
    sight.away_from_eye = -camera.towards_eye;
    sight.cutaway = panel.shown->request.picture.cutaway;
    sight.middle_um = camera.focal_um;
    panel.pick_at(sight);
}

void take_mouse(PanelContext& panel, const Shown& shown) {
    const ImGuiIO& io = ImGui::GetIO();
    PanelModel& model = panel.model;
    if (ImGui::IsItemActivated()) model.begin_drag();
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, k_click_px))
        model.drag(double{io.MouseDelta.x}, double{io.MouseDelta.y});
    if (ImGui::IsItemDeactivated()) {
        model.end_drag();
        const ImVec2 moved = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
        const float farthest = std::sqrt(io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left]);
        if (farthest <= k_click_px && std::abs(moved.x) <= k_click_px)
            pick_at(panel, shown, io.MousePos);
    }
}

void mark_selection(const PanelContext& panel, const Shown& shown) {
    const Pick& selected = *panel.model.selection;
    const Snapshot& snapshot = *panel.shown->request.snapshot;
    const auto node = static_cast<std::size_t>(
        selected.cell * snapshot.header->topology->n_nodes() + selected.node);
    const Vec3 x(double{snapshot.x_um[3 * node]}, double{snapshot.x_um[3 * node + 1]},
                 double{snapshot.x_um[3 * node + 2]});
    const Vec3 shift =
        shift_when_exploded_um(snapshot, panel.shown->request.picture.exploded, selected.cell);
    const render::Camera::Pixel at = panel.shown->camera.project(x + shift);
    const ImVec2 centre{shown.corner.x + shown.scale * static_cast<float>(at.x),
                        shown.corner.y + shown.scale * static_cast<float>(at.y)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ink = IM_COL32(20, 20, 20, 255), paper = IM_COL32(255, 255, 255, 235);
    list.AddCircle(centre, 7.0F, paper, 24, 4.0F);
    list.AddCircle(centre, 7.0F, ink, 24, 1.6F);
    std::string label = "cell " + std::to_string(selected.cell);
    if (selected.other_cell >= 0) label += ", contact with " + std::to_string(selected.other_cell);
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    const ImVec2 corner{centre.x + 12.0F, centre.y - 0.5F * size.y};
    list.AddRectFilled({corner.x - 4.0F, corner.y - 2.0F},
                       {corner.x + size.x + 4.0F, corner.y + size.y + 2.0F}, paper, 3.0F);
    list.AddText(corner, ink, label.c_str());
}

}  // namespace

void draw_picture(PanelContext& panel, float width, float height) {
    if (width < 8.0F || height < 8.0F) return;  // a window of nothing shows nothing
    if (panel.shown == nullptr) {
        ImGui::TextUnformatted(panel.status.empty() ? "waiting for the first frame"
                                                    : panel.status.c_str());
        return;
    }
    const render::Image& image = panel.shown->image;
    Shown shown;
    // One to one where it fits: then the pixels are those of the movie.
    shown.scale = std::min(
        {1.0F, width / static_cast<float>(image.width), height / static_cast<float>(image.height)});
    const ImVec2 size{shown.scale * static_cast<float>(image.width),
                      shown.scale * static_cast<float>(image.height)};
    shown.corner = ImGui::GetCursorScreenPos();
    if (panel.shown->request.sheet) {  // a sheet is not turned, and nothing in it is picked
        ImGui::Image(panel.texture, size);
        return;
    }
    ImGui::InvisibleButton("picture", size);
    ImGui::GetWindowDrawList()->AddImage(panel.texture, shown.corner,
                                         {shown.corner.x + size.x, shown.corner.y + size.y});
    take_mouse(panel, shown);
    if (panel.model.selection) mark_selection(panel, shown);
}

}  // namespace spheroscope::viewer
