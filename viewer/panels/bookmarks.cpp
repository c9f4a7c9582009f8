#include "viewer/panels/panel.hpp"

#include <imgui.h>

namespace spheroscope::viewer {

void draw_bookmarks(PanelContext& panel) {
    if (ImGui::Button("bookmark this")) panel.act(Action::bookmark);
    for (std::size_t k = 0; k < panel.model.bookmarks.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (ImGui::Selectable(panel.model.bookmarks[k].name.c_str()))
            panel.model.open(panel.model.bookmarks[k]);
        ImGui::PopID();
    }
}

}  // namespace spheroscope::viewer
