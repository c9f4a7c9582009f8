#include "viewer/opened_sheet.hpp"

#include "engine/base/error.hpp"
#include "engine/inspect/contact_history.hpp"
#include "viewer/app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace spheroscope::viewer {
namespace {

bool is_contact(const Opened& opened) {
    return std::holds_alternative<inspect::ContactKey>(opened);
}

}  // namespace

void OpenedSheet::follow() {
    try {
        if (watched_ != model_.opened) {
            watched_ = model_.opened;
            frames_.watch_contact(contact_of(watched_));
            model_.message = watched_
                                 ? fmt::format("{}; {} leads back to all cells", text_of(*watched_),
                                               is_contact(*watched_) ? "O" : "F")
                                 : "";
        }
        contact_history_ = frames_.contact_history();
    } catch (const Error& error) {
        close(error.what());
    }
}

void OpenedSheet::close(const Opened& failed, const std::string& why) {
    if (model_.opened == failed) close(why);
}

void OpenedSheet::close(const std::string& why) {
    model_.message = why;
    model_.opened.reset();
    watched_.reset();
    contact_history_ = nullptr;
    frames_.watch_contact({});
}

void OpenedSheet::go_to_event(Action action) {
    if (contact_history_ == nullptr) {
        model_.message = "no contact is open: O opens the one that is picked";
        return;
    }
    const std::vector<inspect::ContactEvent> events = inspect::find_events(*contact_history_);
    const int frame = model_.playback.frame();
    const inspect::ContactEvent* const event = action == Action::event_before
                                                   ? inspect::previous_event(events, frame)
                                                   : inspect::next_event(events, frame);
    if (event == nullptr) {
        model_.message = action == Action::event_before
                             ? "no event of this contact before this frame"
                             : "no event of this contact after this frame";
        return;
    }
    model_.playback.go_to(event->frame);
    model_.message = fmt::format("{}: {} at {:.4g} s", text_of(*watched_),
                                 inspect::name_of(event->kind), event->time_s);
}

std::optional<SheetRequest> OpenedSheet::request_for(const Snapshot& snapshot) const {
    if (!watched_) return {};
    return SheetRequest{*watched_, contact_history_, settings_.drawn_by,
                        fmt::format("spheroscope inspect {} --{} {} --frame {} -o sheet.png",
                                    settings_.run_file, is_contact(*watched_) ? "contact" : "node",
                                    key_text(*watched_), snapshot.frame)};
}

bool OpenedSheet::is_whole(const SheetRequest& request) const {
    if (!is_contact(request.opened)) return true;
    return !request.history->empty() &&
           request.history->back().frame + 1 == model_.playback.n_frames();
}

std::string sheet_name(const SheetRequest& request, int frame) {
    std::string name = text_of(request.opened);
    std::replace(name.begin(), name.end(), ' ', '_');
    std::replace(name.begin(), name.end(), ':', '-');  // file systems that have no colons
    return fmt::format("{}_{:06d}", name, frame);
}

}  // namespace spheroscope::viewer
