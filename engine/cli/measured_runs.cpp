#include "engine/cli/measured_runs.hpp"

#include "engine/store/run_file.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::cli {
namespace {

/// Adds the frames in which a bead presses; none if it does not in the last one. Where it does and
/// a number of a frame is undefined, there is no point to draw: such frames are counted.
void add_load(const RunFileReader& reader, const Snapshot& last, statistics::RunStatistics& run) {
    if (!last.load.probe.acts()) return;
    for (int i = 0; i < reader.n_frames(); ++i) {
        const SnapshotPtr frame = reader.frame(i);
        if (!frame->load.probe.acts()) continue;
        const Totals& t = frame->totals;
        if (std::isfinite(t.probe_way_um) && std::isfinite(t.probe_force_nN) &&
            std::isfinite(t.hull_force_nN))
            run.load.push_back({frame->time_s, t.probe_way_um, t.probe_force_nN, t.hull_force_nN,
                                t.load_imbalance});
        else
            ++run.n_undefined_loads;
    }
}

/// The frames with a wall.
std::vector<statistics::WallPoint> wall_of(const RunFileReader& reader) {
    const std::vector<double> radius_um = reader.number_of_frames("wall_radius");
    const std::vector<double> force_nN = reader.number_of_frames("wall_force");
    std::vector<statistics::WallPoint> wall;
    for (std::size_t i = 0; i < std::min(radius_um.size(), force_nN.size()); ++i)
        if (radius_um[i] > 0.0) wall.push_back({radius_um[i], force_nN[i]});
    return wall;
}

}  // namespace

statistics::RunStatistics measure_stored_run(const std::string& file) {
    const RunFileReader reader(file);
    try {
        if (reader.n_frames() == 0) throw Error("it has no frames yet");
        const SnapshotPtr last = reader.frame(reader.n_frames() - 1);
        statistics::RunStatistics run = statistics::measure_run(last, reader.changes());
        add_load(reader, *last, run);
        run.wall = wall_of(reader);
        run.file = file;
        run.outcome = reader.outcome();
        return run;
    } catch (const Error& error) {
        constexpr std::string_view prefix = "error: ";
        std::string reason = error.what();
        if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
        throw NothingToMeasure(reason);
    }
}

}  // namespace spheroscope::cli
