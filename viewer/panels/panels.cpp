#include "viewer/panels/panel.hpp"

#include <array>

namespace spheroscope::viewer {

std::span<const PanelRow> all_panels() {
    static constexpr std::array<PanelRow, 10> rows{{
        {"Engine", Side::right, true, true, draw_live},
        {"Inside a step", Side::right, false, true, draw_step, step_is_new},
        {"Contact", Side::right, false, false, draw_contact, contact_is_new},
        {"View", Side::right, true, false, draw_view},
        {"Selection", Side::right, true, false, draw_selection},
        {"Bookmarks", Side::right, false, false, draw_bookmarks},
        {"Keys", Side::right, false, false, draw_keys},
        {"Timeline", Side::below, true, false, draw_timeline},
        {"Health", Side::below, true, false, draw_health},
        {"Plots", Side::below, true, false, draw_plots},
    }};
    return rows;
}

}  // namespace spheroscope::viewer
