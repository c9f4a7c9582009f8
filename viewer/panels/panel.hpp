#pragma once

#include "viewer/model/panel_model.hpp"
#include "viewer/model/series.hpp"
#include "viewer/painter.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

struct ImFont;

namespace spheroscope::viewer {

class LiveRun;

/// What panels read and change. Made anew for each frame of the panel.
struct PanelContext {
    PanelModel& model;
    const RunHeader& header;
    const PaintedPicture* shown;              ///< the picture on show; nullptr before the first
    SnapshotPtr snapshot;                     ///< what it shows
    std::span<const FrameSummary> summaries;  ///< of the frames that were looked at so far
    const Curve& radial_stress;               ///< of the snapshot
    const Curve& force_distribution;
    const std::string& status;
    LiveRun* live;  ///< nullptr: there is no engine behind the frames
    std::function<void(Action)> act;
    std::function<void(const Sight&)> pick_at;
    ContactRows contact_history;  ///< of the open contact; nullptr: none is open
    void* texture;
    ImFont* small_font;
};

/// Where a panel stands.
enum class Side { right, below };

/// One row of the table of panels. A new panel is a new file and one row.
struct PanelRow {
    std::string_view title;
    Side side;
    bool opened;        ///< at the start; panels on the right can be folded
    bool needs_engine;  ///< shown only with a running engine behind the frames
    void (*draw)(PanelContext&);
    /// Whether it has something new to show, for which it is unfolded; empty: never.
    bool (*has_news)(const PanelModel&) = nullptr;
    [[nodiscard]] bool opens_for(const PanelModel& model) const {
        return has_news != nullptr && has_news(model);
    }
};
[[nodiscard]] std::span<const PanelRow> all_panels();

/// What, value and unit in three columns; a row without a value is a heading.
void draw_table(const std::vector<TableRow>& rows, float first_px = 150.0F);

// One file each.
void draw_picture(PanelContext& panel, float width, float height);
void draw_live(PanelContext& panel);
void draw_step(PanelContext& panel);
[[nodiscard]] bool step_is_new(const PanelModel& model);
void draw_view(PanelContext& panel);
void draw_selection(PanelContext& panel);
void draw_contact(PanelContext& panel);
[[nodiscard]] bool contact_is_new(const PanelModel& model);
void draw_bookmarks(PanelContext& panel);
void draw_keys(PanelContext& panel);
void draw_timeline(PanelContext& panel);
void draw_health(PanelContext& panel);
void draw_plots(PanelContext& panel);

}  // namespace spheroscope::viewer
