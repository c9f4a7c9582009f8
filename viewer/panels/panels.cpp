#include "viewer/panels/panel.hpp"

#include <array>

namespace spheroscope::viewer {

std::span<const PanelRow> all_panels() {
    static constexpr std::array<PanelRow, 7> rows{{
        {"View", Side::right, true, draw_view},
        {"Selection", Side::right, true, draw_selection},
        {"Bookmarks", Side::right, false, draw_bookmarks},
        {"Keys", Side::right, false, draw_keys},
        {"Timeline", Side::below, true, draw_timeline},
        {"Health", Side::below, true, draw_health},
        {"Plots", Side::below, true, draw_plots},
    }};
    return rows;
}

}  // namespace spheroscope::viewer
