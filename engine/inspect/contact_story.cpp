#include "engine/inspect/contact_story.hpp"

#include "engine/inspect/inspect_contact.hpp"

#include <algorithm>
#include <utility>

namespace spheroscope::inspect {

ContactStory tell_contact(const std::shared_ptr<const RunHeader>& header, const ReadFrame& read,
                          int n_frames, const ContactKey& key) {
    ContactStory story;
    story.header = header;
    story.key = key;
    story.history = contact_history(header, read, n_frames, key);
    if (std::none_of(story.history.begin(), story.history.end(),
                     [](const ContactSummary& s) { return s.exists && !s.is_seeding; })) {
        std::string near;
        if (n_frames > 0)
            for (const ContactKey& other : nearest_contacts(*read(n_frames - 1), key, 4))
                near += (near.empty() ? "" : ", ") + other.text();
        throw Error("cells " + std::to_string(key.cell_a) + " and " + std::to_string(key.cell_b) +
                        " touch in no frame of the run",
                    near.empty() ? "no cells touch in the last frame"
                                 : "nearest contacts in the last frame: " + near);
    }
    story.events = find_events(story.history);
    const auto pair = std::make_shared<FrameSystem>(
        header, std::vector<int>{key.cell_a, key.cell_b}, FrameSystem::Detail::contacts);
    story.at = [pair, read, key](int frame) { return contact_in(*pair, read(frame), key); };
    return story;
}

ContactMoment contact_in(FrameSystem& pair, SnapshotPtr frame, const ContactKey& key) {
    pair.load(frame);
    ContactMoment moment{std::move(frame), summarize(pair, key), {}};
    if (moment.summary.exists) moment.report = inspect_contact(pair, key);
    return moment;
}

NodeMoment node_in(FrameSystem& whole, SnapshotPtr frame, const NodeOfCell& node) {
    whole.load(frame);
    return {std::move(frame), forces_on_node(whole, node.cell, node.node)};
}

}  // namespace spheroscope::inspect
