#include "viewer/model/panel_model.hpp"

#include "engine/base/error.hpp"
#include "viewer/model/blame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace spheroscope::viewer {

std::span<const KeyRow> all_keys() {
    using enum Action;
    static constexpr std::array<KeyRow, 24> rows{{
        {Key::space, false, false, toggle_playing, "Space", "play, pause"},
        {Key::period, false, false, single_step, ".", "one step of a running engine"},
        {Key::n, false, false, until_event, "N", "on to the next event, as above"},
        {Key::i, false, false, look_into_step, "I", "look into the next step, term by term"},
        {Key::o, false, false, open_contact, "O", "open the picked contact, and back"},
        {Key::f, false, false, open_node, "F", "forces on the picked node, and back"},
        {Key::left, false, true, event_before, "Ctrl ←", "to the contact's event before"},
        {Key::right, false, true, event_after, "Ctrl →", "to its next event"},
        {Key::left, false, false, back, "←", "one frame back"},
        {Key::right, false, false, forward, "→", "one frame on"},
        {Key::left, true, false, back_10, "Shift ←", "ten frames back"},
        {Key::right, true, false, forward_10, "Shift →", "ten frames on"},
        {Key::home, false, false, first, "Home", "first frame"},
        {Key::end, false, false, last, "End", "last frame"},
        {Key::z, false, true, undo, "Ctrl Z", "undo a change of the view"},
        {Key::y, false, true, redo, "Ctrl Y", "redo it"},
        {Key::z, true, true, redo, "Ctrl Shift Z", "redo it"},
        {Key::p, false, false, save_picture, "P", "save the picture, as the movie has it"},
        {Key::p, true, false, save_panel, "Shift P", "save the whole panel"},
        {Key::c, false, true, copy_view, "Ctrl C", "copy the view as scene text"},
        {Key::t, false, true, copy_table, "Ctrl T", "copy the table as CSV"},
        {Key::b, false, false, bookmark, "B", "bookmark frame and view"},
        {Key::q, false, true, quit, "Ctrl Q", "quit"},
        {Key::q, false, false, quit, "Q", "quit"},
    }};
    return rows;
}

PanelModel::PanelModel(std::vector<scene::Picture> presets)
    : view(ViewSettings{presets.at(0)}), presets_(std::move(presets)) {}

std::optional<Action> PanelModel::action_of(Key key, bool shift, bool control) {
    for (const KeyRow& row : all_keys())
        if (row.key == key && row.shift == shift && row.control == control) return row.action;
    return {};
}

std::optional<Action> PanelModel::act(Action action) {
    switch (action) {
    case Action::toggle_playing: playback.toggle_playing(); return {};
    case Action::back:
        if (shows_engine() && live->n_looks > 0)
            look_back();
        else
            playback.step(-1);
        return {};
    case Action::forward:
        if (shows_engine())
            live->looks_back = std::max(0, live->looks_back - 1);
        else
            playback.step(1);
        return {};
    case Action::back_10: playback.step(-10); return {};
    case Action::forward_10: playback.step(10); return {};
    case Action::first: playback.go_to(0); return {};
    case Action::last:
        if (live)
            follow_engine();
        else
            playback.go_to(playback.n_frames() - 1);
        return {};
    case Action::undo: view.undo(); return {};
    case Action::open_contact: toggle_contact(); return {};
    case Action::open_node: toggle_node(); return {};
    case Action::redo: view.redo(); return {};
    case Action::save_picture:
        playback.step(0);  // playing ends: the picture of the frame that was asked for is drawn
        return action;
    case Action::bookmark: add_bookmark(); return action;
    default: return action;
    }
}

void PanelModel::open_in_place(const Opened& wanted) {
    opened = wanted;
    opened_is_new = true;
}

void PanelModel::toggle_node() {
    if (opened && std::holds_alternative<NodeOfCell>(*opened)) {
        opened.reset();
        return;
    }
    if (!selection) {
        message = "no node is picked: a click on a cell picks one";
        return;
    }
    open_in_place(NodeOfCell{selection->cell, selection->node});
}

void PanelModel::toggle_contact() {
    if (contact_of(opened)) {
        opened.reset();
        return;
    }
    if (!selection || selection->other_cell < 0) {
        message = "no contact is picked: a click where two cells touch picks one";
        return;
    }
    const auto [a, b] = std::minmax(selection->cell, selection->other_cell);
    open_in_place(inspect::ContactKey{a, b});
}

void PanelModel::follow_engine() {
    playback.follow_end();
    live->looks_back = 0;
}

void PanelModel::look_back() {
    if (live->looks_back + 1 < live->n_looks) {
        ++live->looks_back;
        return;
    }
    // From the oldest look to the frame before it.
    const auto times = playback.time_s();
    const auto after = std::lower_bound(times.begin(), times.end(), live->oldest_look_s);
    playback.go_to(static_cast<int>(after - times.begin()) - 1);
}

void PanelModel::drag(double right_px, double down_px) {
    view.change(turned(view.now(), right_px, down_px));
}

void PanelModel::go_to_typed_time(const std::string& text) {
    try {
        playback.go_to_time(parse_time_s(text));
        message.clear();
    } catch (const Error& error) {
        message = error.what();
    }
}

void PanelModel::go_to_blame(int frame, const SeriesRow& row) {
    playback.go_to(frame);
    blaming_ = &row;
    blamed_frame_ = frame;
}

void PanelModel::pick_blamed(const Snapshot& on_show) {
    if (playback.frame() != blamed_frame_) blaming_ = nullptr;
    if (blaming_ == nullptr || on_show.frame != blamed_frame_) return;
    const SeriesRow& row = *std::exchange(blaming_, nullptr);
    try {
        const std::optional<Pick> worst = blamed(row, on_show);
        if (!worst) return;
        selection = worst;
        message = worst->other_cell < 0
                      ? fmt::format("cell {} is picked", worst->cell)
                      : fmt::format("the contact of cells {} and {} is picked; O opens it",
                                    worst->cell, worst->other_cell);
    } catch (const Error& error) {
        message = error.what();
    }
}

void PanelModel::add_bookmark() {
    if (playback.frame() < 0) return;
    bookmarks.push_back({fmt::format("frame {}, {}", playback.frame(), view.now().picture.field),
                         playback.frame(), view.now()});
}

void PanelModel::open(const Bookmark& bookmark) {
    playback.go_to(bookmark.frame);
    view.change(bookmark.view);
}

}  // namespace spheroscope::viewer
