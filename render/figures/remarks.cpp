// What is said below every figure about its runs.
#include "engine/base/counted.hpp"
#include "render/figures/figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace spheroscope::figures {
namespace {

/// "" for a run that came to the end that its scene asks for.
std::string remark_on_outcome(const statistics::RunStatistics& run) {
    if (run.outcome == "cap") return "ended at the cap of time, not at rest";
    if (run.has_ended()) return "";
    return run.outcome.empty()
               ? "not at its end, the last frame is shown"
               : fmt::format("not at its end ({}), the last frame is shown", run.outcome);
}

}  // namespace

std::vector<std::string> remarks_on_runs(Setups setups) {
    std::vector<std::string> remarks;
    std::set<std::string> versions;
    std::size_t most = 0;
    for (const statistics::SetupStatistics& setup : setups) {
        most = std::max(most, setup.runs.size());
        std::map<std::string, std::vector<std::uint64_t>> seeds_of;  // what is to be said of them
        for (const statistics::RunStatistics& run : setup.runs) {
            versions.insert(run.version);
            const std::string remark = remark_on_outcome(run);
            if (!remark.empty()) seeds_of[remark].push_back(run.seed);
        }
        for (const auto& [remark, seeds] : seeds_of)
            remarks.push_back(
                fmt::format("{}, seed {}: {}", setup.label, fmt::join(seeds, ", "), remark));
        std::istringstream changes(setup.setup().changes);
        for (std::string change; std::getline(changes, change);)
            remarks.push_back(fmt::format("{}: changed on the way (s, key, value in um, s, nN): {}",
                                          setup.label, change));
    }
    for (const statistics::SetupStatistics& setup : setups)
        if (setup.runs.size() < most)
            remarks.push_back(fmt::format("{} has {}, others have {}", setup.label,
                                          counted(setup.runs.size(), "seed"), most));
    if (versions.size() > 1)
        remarks.push_back(fmt::format("runs of several versions: {}", fmt::join(versions, ", ")));
    return remarks;
}

}  // namespace spheroscope::figures
