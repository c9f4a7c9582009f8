#include "viewer/model/live_events.hpp"

#include <fmt/format.h>

#include <map>
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

std::map<Pair, float> forces_nN(const Snapshot& snapshot, const Watched& watched) {
    std::map<Pair, float> forces;
    for (const ContactLink& link : snapshot.links)
        if (is_watched(link, watched)) forces[{link.cell_a, link.cell_b}] = link.force_nN;
    return forces;
}

}  // namespace

std::optional<std::string> event_between(const Snapshot& before, const Snapshot& now,
                                         const Watched& watched) {
    if (before.stage != now.stage)
        return fmt::format("t = {:.4g} s: stage {}, {}, begins", now.time_s, now.stage,
                           now.stage_name);
    if (now.stage_name == "anneal") return {};
    const std::map<Pair, float> earlier = forces_nN(before, watched);
    const std::map<Pair, float> later = forces_nN(now, watched);
    std::vector<std::pair<Pair, std::string_view>> events;
    for (const auto& [pair, force_nN] : later) {
        const auto found = earlier.find(pair);
        if (found == earlier.end())
            events.push_back({pair, "forms"});
        else if ((found->second < 0.0F) != (force_nN < 0.0F))
            events.push_back({pair, force_nN < 0.0F ? "begins to pull" : "begins to push"});
    }
    for (const auto& [pair, force_nN] : earlier)
        if (!later.contains(pair)) events.push_back({pair, "breaks"});
    if (events.empty()) return {};
    const auto& [pair, what] = events.front();
    const std::string others =
        events.size() > 1 ? fmt::format(", and {} more", events.size() - 1) : "";
    return fmt::format("t = {:.4g} s: contact {}-{} {}{}", now.time_s, pair.first, pair.second,
                       what, others);
}

}  // namespace spheroscope::viewer
