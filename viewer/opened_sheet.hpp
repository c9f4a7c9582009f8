#pragma once

#include "viewer/frames.hpp"
#include "viewer/model/panel_model.hpp"
#include "viewer/painter.hpp"

#include <optional>
#include <string>

namespace spheroscope::viewer {

struct AppSettings;

/// What is open in place of all cells: what it needs of the frames, what it asks of the painter,
/// and its way back.
class OpenedSheet {
  public:
    OpenedSheet(Frames& frames, PanelModel& model, const AppSettings& settings)
        : frames_(frames), model_(model), settings_(settings) {}

    /// Watches what is open, and takes what has become known of a contact's history.
    void follow();
    /// Back to all cells, because this cannot be shown.
    void close(const std::string& why);
    /// The same, because drawing this has failed: nothing, if it is no longer what is open.
    void close(const Opened& failed, const std::string& why);
    /// To the open contact's event before or after the frame on show.
    void go_to_event(Action action);

    [[nodiscard]] const std::optional<Opened>& opened() const { return watched_; }
    /// Of the open contact; nullptr: none is open.
    [[nodiscard]] const ContactRows& contact_history() const { return contact_history_; }
    [[nodiscard]] std::optional<SheetRequest> request_for(const Snapshot& snapshot) const;
    /// Whether the sheet has what all frames have to say.
    [[nodiscard]] bool is_whole(const SheetRequest& request) const;

  private:
    Frames& frames_;
    PanelModel& model_;
    const AppSettings& settings_;
    std::optional<Opened> watched_;
    ContactRows contact_history_;
};

/// Of a picture that is saved, without ending: "contact_17-42_000012".
[[nodiscard]] std::string sheet_name(const SheetRequest& request, int frame);

}  // namespace spheroscope::viewer
