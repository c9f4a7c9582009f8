#include "engine/inspect/contact_history.hpp"

#include "engine/inspect/inspect_contact.hpp"

#include <algorithm>
#include <utility>

namespace spheroscope::inspect {

std::vector<ContactSummary> contact_history(const std::shared_ptr<const RunHeader>& header,
                                            const ReadFrame& read, int n_frames,
                                            const ContactKey& key) {
    ContactHistorian historian(header, key);
    std::vector<ContactSummary> history;
    for (int frame = 0; frame < n_frames; ++frame)
        history.push_back(historian.summary_of(read(frame)));
    return history;
}

struct ContactHistorian::Hidden {
    ContactKey key;
    FrameSystem pair;
};

ContactHistorian::ContactHistorian(const std::shared_ptr<const RunHeader>& header,
                                   const ContactKey& key) {
    check_cells(*header, key);
    hidden_ = std::make_unique<Hidden>(
        Hidden{key, {header, {key.cell_a, key.cell_b}, FrameSystem::Detail::contacts}});
}

ContactHistorian::~ContactHistorian() = default;

ContactSummary ContactHistorian::summary_of(SnapshotPtr frame) {
    hidden_->pair.load(std::move(frame));
    return summarize(hidden_->pair, hidden_->key);
}

std::string_view name_of(EventKind kind) {
    switch (kind) {
    case EventKind::forms: return "forms";
    case EventKind::breaks: return "breaks";
    case EventKind::sign_change: return "sign change";
    }
    return "";
}

std::optional<EventKind> event_between(const ForceOfContact& before, const ForceOfContact& now) {
    if (before.exists != now.exists) return now.exists ? EventKind::forms : EventKind::breaks;
    if (now.exists && (before.force_nN > 0.0) != (now.force_nN > 0.0))
        return EventKind::sign_change;
    return {};
}

std::vector<ContactEvent> find_events(std::span<const ContactSummary> history) {
    std::vector<ContactEvent> events;
    for (std::size_t i = 1; i < history.size(); ++i) {
        const ContactSummary &before = history[i - 1], &now = history[i];
        if (before.is_seeding) continue;
        const double f0 = before.normal_force_nN, f1 = now.normal_force_nN;
        const std::optional<EventKind> kind = event_between({before.exists, f0}, {now.exists, f1});
        if (!kind) continue;
        const double time_s = *kind == EventKind::sign_change
                                  ? before.time_s + f0 / (f0 - f1) * (now.time_s - before.time_s)
                                  : now.time_s;
        events.push_back({*kind, now.frame, time_s, f0, f1});
    }
    return events;
}

const ContactEvent* next_event(std::span<const ContactEvent> events, int frame) {
    const auto found = std::find_if(events.begin(), events.end(),
                                    [&](const ContactEvent& event) { return event.frame > frame; });
    return found == events.end() ? nullptr : &*found;
}

const ContactEvent* previous_event(std::span<const ContactEvent> events, int frame) {
    const auto found = std::find_if(events.rbegin(), events.rend(),
                                    [&](const ContactEvent& event) { return event.frame < frame; });
    return found == events.rend() ? nullptr : &*found;
}

}  // namespace spheroscope::inspect
