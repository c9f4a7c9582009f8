#include "viewer/model/live_events.hpp"

#include "engine/inspect/contact_history.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace spheroscope::viewer {
namespace {

using Pair = std::pair<int, int>;

bool is_watched(const ContactLink& link, const Watched& watched) {
    const auto has = [&](int cell) { return link.cell_a == cell || link.cell_b == cell; };
    return (watched.cell < 0 || has(watched.cell)) &&
           (watched.other_cell < 0 || has(watched.other_cell));
}

std::map<Pair, double> forces_nN(const Snapshot& snapshot, const Watched& watched) {
    std::map<Pair, double> forces;
    for (const ContactLink& link : snapshot.links)
        if (is_watched(link, watched)) forces[{link.cell_a, link.cell_b}] = double{link.force_nN};
    return forces;
}

inspect::ForceOfContact contact_in(const std::map<Pair, double>& forces_nN, const Pair& pair) {
    const auto found = forces_nN.find(pair);
    if (found == forces_nN.end()) return {};
    return {true, found->second};
}

std::string_view words_of(inspect::EventKind kind, double force_nN) {
    if (kind != inspect::EventKind::sign_change) return inspect::name_of(kind);
    return force_nN > 0.0 ? "begins to push" : "begins to pull";
}

}  // namespace

std::optional<std::string> event_between(const Snapshot& before, const Snapshot& now,
                                         const Watched& watched) {
    if (before.stage != now.stage)
        return fmt::format("t = {:.4g} s: stage {}, {}, begins", now.time_s, now.stage,
                           now.stage_name);
    if (now.stage_name == "anneal") return {};
    const std::map<Pair, double> earlier = forces_nN(before, watched);
    const std::map<Pair, double> later = forces_nN(now, watched);
    std::set<Pair> pairs;
    for (const auto* forces : {&later, &earlier})
        for (const auto& [pair, force_nN] : *forces) pairs.insert(pair);
    std::vector<std::pair<Pair, std::string_view>> events;
    for (const Pair& pair : pairs) {
        const inspect::ForceOfContact contact = contact_in(later, pair);
        if (const auto kind = inspect::event_between(contact_in(earlier, pair), contact))
            events.push_back({pair, words_of(*kind, contact.force_nN)});
    }
    if (events.empty()) return {};
    const auto& [pair, what] = events.front();
    const std::string others =
        events.size() > 1 ? fmt::format(", and {} more", events.size() - 1) : "";
    return fmt::format("t = {:.4g} s: contact {}-{} {}{}", now.time_s, pair.first, pair.second,
                       what, others);
}

}  // namespace spheroscope::viewer
