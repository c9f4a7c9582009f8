#pragma once

#include "engine/run/step_anatomy.hpp"
#include "viewer/model/bookmarks.hpp"
#include "viewer/model/history.hpp"
#include "viewer/model/opened.hpp"
#include "viewer/model/pick.hpp"
#include "viewer/model/playback.hpp"
#include "viewer/model/series.hpp"
#include "viewer/model/view.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::viewer {

/// What a key, a button or a click asks for.
enum class Action {
    toggle_playing,
    single_step,
    until_event,
    look_into_step,
    open_contact,
    open_node,
    event_before,
    event_after,
    back,
    forward,
    back_10,
    forward_10,
    first,
    last,
    undo,
    redo,
    save_picture,
    save_panel,
    copy_view,
    copy_table,
    bookmark,
    quit,
};

/// Keys by name; the window knows their numbers.
enum class Key { space, left, right, home, end, period, b, c, f, n, i, o, p, q, t, y, z };

/// A row of the table of keys; the window, the help and the tests loop over it.
struct KeyRow {
    Key key;
    bool shift, control;
    Action action;
    std::string_view keys, meaning;
};
[[nodiscard]] std::span<const KeyRow> all_keys();

/// With a running engine behind the frames there are states that are newer than the last of
/// them, or lie between them.
struct LiveLooks {
    double oldest_look_s = 0.0;
    int n_looks = 0;          ///< states that are kept
    int looks_back = 0;       ///< which of them is on show while the end is followed; 0: the newest
    std::string dragged_key;  ///< the parameter whose slider is held
    double dragged_value = 0.0;  ///< where it is held
    /// The step that was taken apart last, and which of its moments is on show.
    std::shared_ptr<const StepAnatomy> anatomy;
    int moment = 0;
    bool anatomy_is_new = false;  ///< nobody has seen it yet
};

/// Everything that the panel knows, without a window: what is shown, and how input changes it.
class PanelModel {
  public:
    /// The scene's own pictures, at least one; the first is shown.
    explicit PanelModel(std::vector<scene::Picture> presets);

    Playback playback;
    History<ViewSettings> view;
    std::vector<Bookmark> bookmarks;
    std::optional<Pick> selection;
    std::optional<Opened> opened;       ///< what is shown in place of the cells
    bool opened_is_new = false;         ///< nobody has seen its panel yet
    std::string message;                ///< the last thing that there was to say
    std::array<char, 32> typed_time{};  ///< what stands in the field for a time

    std::optional<LiveLooks> live;  ///< empty without a running engine
    /// Shows the newest state, and stays with it.
    void follow_engine();
    /// Whether states of the engine are shown, not a frame that was chosen.
    [[nodiscard]] bool shows_engine() const { return live && playback.follows_end(); }

    [[nodiscard]] const std::vector<scene::Picture>& presets() const { return presets_; }
    void change_view(const ViewSettings& to) { view.change(to); }

    /// Does what can be done here. What needs a window or files (pictures, clipboard, bookmarks'
    /// file, quitting) is returned for the caller to do.
    [[nodiscard]] std::optional<Action> act(Action action);
    /// The action of a key; nothing if it has none.
    [[nodiscard]] static std::optional<Action> action_of(Key key, bool shift, bool control);

    void begin_drag() { view.begin_drag(); }
    void drag(double right_px, double down_px);
    void end_drag() { view.end_drag(); }
    /// While the view is being turned, speed matters more than smooth edges.
    [[nodiscard]] bool wants_draft() const { return view.is_being_moved(); }

    /// A time as typed; what is wrong with it becomes the message.
    void go_to_typed_time(const std::string& text);
    /// Goes to a frame in which a row is beyond its limit. What is to blame (viewer/model/blame) is
    /// picked once the frame is on show, by pick_blamed(), if nobody has gone elsewhere by then.
    void go_to_blame(int frame, const SeriesRow& row);
    void pick_blamed(const Snapshot& on_show);
    void add_bookmark();
    void open(const Bookmark& bookmark);

  private:
    void look_back();
    // What is picked, or back to all cells.
    void toggle_contact();
    void toggle_node();
    void open_in_place(const Opened& wanted);

    std::vector<scene::Picture> presets_;
    const SeriesRow* blaming_ = nullptr;  ///< the row whose cell is to be picked
    int blamed_frame_ = -1;
};

}  // namespace spheroscope::viewer
