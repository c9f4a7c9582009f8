// What is said below every figure about its runs.
#include "engine/base/counted.hpp"
#include "engine/scene/differences.hpp"
#include "engine/statistics/motion_at_end.hpp"
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

/// What tells setups apart whose labels differ in a number in brackets alone, a line for each of
/// them.
void add_differences(Setups setups, std::vector<std::string>& remarks) {
    std::map<std::string, std::vector<const statistics::SetupStatistics*>> with_label;
    for (const statistics::SetupStatistics& setup : setups)
        if (!setup.shared_label.empty()) with_label[setup.shared_label].push_back(&setup);
    for (const auto& [label, alike] : with_label) {
        std::vector<std::vector<scene::Setting>> settings;
        for (const statistics::SetupStatistics* setup : alike)
            settings.push_back(scene::settings_of_motion(setup->setup().scene_alone, label));
        const std::vector<std::string> differences = scene::what_differs(settings);
        for (std::size_t i = 0; i < alike.size(); ++i)
            remarks.push_back(fmt::format("{}: {}", alike[i]->label,
                                          differences[i].empty() ? "the same settings of its motion"
                                                                 : differences[i]));
    }
}

}  // namespace

std::vector<std::string> remarks_on_runs(Setups setups) {
    std::vector<std::string> remarks;
    add_differences(setups, remarks);
    std::set<std::string> versions;
    std::size_t most = 0;
    for (const statistics::SetupStatistics& setup : setups) {
        most = std::max(most, setup.runs.size());
        std::map<std::string, std::vector<std::uint64_t>> seeds_of;  // what is to be said of them
        for (const statistics::RunStatistics& run : setup.runs) {
            versions.insert(run.version);
            const std::string remark = remark_on_outcome(run);
            if (!remark.empty()) seeds_of[remark].push_back(run.seed);
            if (run.n_undefined_loads > 0)
                seeds_of[fmt::format("no points of {} under the bead: undefined force or way",
                                     counted(run.n_undefined_loads, "frame"))]
                    .push_back(run.seed);
        }
        for (const auto& [remark, seeds] : seeds_of)
            remarks.push_back(
                fmt::format("{}, seed {}: {}", setup.label, fmt::join(seeds, ", "), remark));
        std::vector<statistics::MotionAtEnd> ends;
        for (const statistics::RunStatistics& run : setup.runs)
            ends.push_back({run.seed, run.outcome, run.totals.normal_speed_rms_um_per_s});
        if (const std::string motion = statistics::remark_on_motion(ends); !motion.empty())
            remarks.push_back(setup.label + ", " + motion);
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
