// What is said below every figure about its runs.
#include "engine/base/counted.hpp"
#include "render/figures/figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace spheroscope::figures {

std::vector<std::string> remarks_on_runs(Setups setups) {
    std::vector<std::string> remarks;
    std::set<std::string> versions;
    std::size_t most = 0;
    for (const statistics::SetupStatistics& setup : setups) {
        most = std::max(most, setup.runs.size());
        std::vector<std::uint64_t> unfinished, capped;
        for (const statistics::RunStatistics& run : setup.runs) {
            versions.insert(run.version);
            if (run.outcome.empty())
                unfinished.push_back(run.seed);
            else if (run.outcome == "cap")
                capped.push_back(run.seed);
        }
        if (!unfinished.empty())
            remarks.push_back(fmt::format("{}, seed {}: not at its end, the last frame is shown",
                                          setup.label, fmt::join(unfinished, ", ")));
        if (!capped.empty())
            remarks.push_back(fmt::format("{}, seed {}: ended at the cap of time, not at rest",
                                          setup.label, fmt::join(capped, ", ")));
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
