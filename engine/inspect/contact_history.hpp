#pragma once

#include "engine/inspect/contact_report.hpp"
#include "engine/run/snapshot.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace spheroscope::inspect {

/// Frames from wherever they are kept; called with ascending numbers.
using ReadFrame = std::function<SnapshotPtr(int frame)>;

/// The numbers of one contact in frames 0 ... n_frames - 1. Only its two cells are computed with:
/// some milliseconds a frame. Throws Error when there is no such cell, and what the reader throws.
[[nodiscard]] std::vector<ContactSummary>
contact_history(const std::shared_ptr<const RunHeader>& header, const ReadFrame& read, int n_frames,
                const ContactKey& key);

/// The same, of frames as they come.
class ContactHistorian {
  public:
    /// Throws Error when there is no such cell.
    ContactHistorian(const std::shared_ptr<const RunHeader>& header, const ContactKey& key);
    ~ContactHistorian();
    /// Throws Error when the frame does not fit the run.
    [[nodiscard]] ContactSummary summary_of(SnapshotPtr frame);

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

enum class EventKind { forms, breaks, sign_change };
[[nodiscard]] std::string_view name_of(EventKind kind);  ///< "forms", "breaks", "sign change"

/// A contact at one moment, as far as events are concerned: whether its area is above the scene's
/// measures.touching_area, and the force by whose sign it pushes (> 0) or pulls (< 0).
struct ForceOfContact {
    bool exists = false;
    double force_nN = 0.0;
};
/// What happened from one moment to the next; nullopt: nothing. All that is called an event of a
/// contact asks this.
[[nodiscard]] std::optional<EventKind> event_between(const ForceOfContact& before,
                                                     const ForceOfContact& now);

/// Something that happened to a contact between one frame and the next.
struct ContactEvent {
    EventKind kind;
    int frame;      ///< the first one in which it is seen
    double time_s;  ///< of that frame; of a sign change: where the force, drawn as a straight line
                    ///< between both frames, is zero
    double force_before_nN, force_after_nN;  ///< normal force in the frame before and in this one
};
/// Ascending, by the sign of the normal force. A contact that is there in the first frame has
/// formed before the file begins: that is no event, and neither is what happens while beads are
/// being packed.
[[nodiscard]] std::vector<ContactEvent> find_events(std::span<const ContactSummary> history);

/// The first event after `frame`, the last one before it; nullptr if there is none.
[[nodiscard]] const ContactEvent* next_event(std::span<const ContactEvent> events, int frame);
[[nodiscard]] const ContactEvent* previous_event(std::span<const ContactEvent> events, int frame);

}  // namespace spheroscope::inspect
