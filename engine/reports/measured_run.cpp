#include "engine/reports/measured_run.hpp"

#include "engine/reports/machine.hpp"
#include "engine/stages/choices.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::reports {
namespace {

const std::atomic<bool> k_never{false};

/// Index of a field in a frame, or -1.
int field_index(const RunHeader& header, std::string_view name) {
    for (std::size_t i = 0; i < header.fields.size(); ++i)
        if (header.fields[i]->name == name) return static_cast<int>(i);
    return -1;
}

std::vector<float> field_of(const Snapshot& frame, std::string_view name) {
    const int index = field_index(*frame.header, name);
    return index < 0 ? std::vector<float>{} : frame.fields[static_cast<std::size_t>(index)];
}

}  // namespace

int count_flipped_triangles(const MeshTopology& mesh, std::span<const Vec3> x_um) {
    int n_flipped = 0;
    const auto n = static_cast<std::size_t>(mesh.n_nodes());
    for (std::size_t begin = 0; begin + n <= x_um.size(); begin += n) {
        const std::span<const Vec3> x = x_um.subspan(begin, n);
        const auto at = [&](int node) { return x[static_cast<std::size_t>(node)]; };
        Vec3 centre = Vec3::Zero();
        for (const Vec3& node : x) centre += (node - x[0]) / static_cast<double>(n);
        centre += x[0];
        for (const auto& [i, j, k] : mesh.triangles) {
            const Vec3 normal = (at(j) - at(i)).cross(at(k) - at(i));
            if (normal.dot((at(i) + at(j) + at(k)) / 3.0 - centre) < 0.0) ++n_flipped;
        }
    }
    return n_flipped;
}

MeasuredRun measure_run(const scene::Scene& scene, const MeasuredRunOptions& options) {
    EngineOptions engine_options;
    engine_options.threads = options.threads;
    engine_options.wall_limit_s = options.wall_limit_s;
    Engine engine(scene, engine_options);

    MeasuredRun run;
    std::atomic<bool> too_long{false};
    const std::atomic<bool>& outer = options.stop != nullptr ? *options.stop : k_never;
    const int last_stage = static_cast<int>(scene.stages.size()) - 1;
    SnapshotPtr last;
    std::vector<Vec3> before;
    const auto watch_step = [&] {
        const std::vector<Vec3>& x = engine.state().state.x_um;
        const MeshTopology& mesh = *engine.header()->topology;
        // not while beads are packed, or on a coarser mesh than that of the frames
        const bool is_whole =
            x.size() == engine.state().radius_um.size() * static_cast<std::size_t>(mesh.n_nodes());
        if (options.watch_flips && is_whole)
            run.most_flipped_triangles =
                std::max(run.most_flipped_triangles, count_flipped_triangles(mesh, x));
        if (!options.watch_steps) return;
        // the first look compares with nothing: beads may have been replaced by cells
        if (before.size() == x.size())
            for (std::size_t i = 0; i < x.size(); ++i)
                run.largest_step_um = std::max(run.largest_step_um, (x[i] - before[i]).norm());
        if (engine.state().diagnostics.steps > 0) before = x;
    };
    EngineSinks sinks;
    sinks.frame = [&](SnapshotPtr frame) -> std::optional<std::string> {
        const State& state = engine.state().state;
        if (frame->stage == last_stage && frame->stage_progress > 0.0)
            run.samples.push_back({state.time_s, state.x_um});
        run.most_flipped_triangles =
            std::max(run.most_flipped_triangles, frame->totals.n_flipped_triangles);
        last = std::move(frame);
        run.fastest_rate_per_s = std::max(run.fastest_rate_per_s, state.fastest_rate_per_s);
        watch_step();
        return {};
    };
    sinks.progress = [&](const RunProgress& progress) {
        if (outer.load() || (options.max_steps > 0 && progress.steps >= options.max_steps))
            too_long = true;
        run.fastest_rate_per_s =
            std::max(run.fastest_rate_per_s, engine.state().state.fastest_rate_per_s);
        watch_step();
    };
    const double cpu_s = cpu_clock_s();
    const RunResult result = engine.run(sinks, too_long);
    run.cpu_s = cpu_clock_s() - cpu_s;
    run.wall_s = result.wall_s;
    run.verdict = result.verdict;
    run.outcome = result.outcome;
    run.message = result.message;
    run.time_s = result.time_s;
    run.work = result.work;
    run.state_hash = result.state_hash;
    if (last != nullptr) {
        run.end.totals = last->totals;
        run.end.links = last->links;
        run.end.gamma_eff_nN_per_um = field_of(*last, "gamma_eff");
        run.end.sigma_h_kPa = field_of(*last, "sigma_h");
        // volumes from the positions: those of a frame are rounded to single precision
        const MeshTopology& mesh = *engine.header()->topology;
        const auto n = static_cast<std::size_t>(mesh.n_nodes());
        const std::vector<Vec3>& x = engine.state().state.x_um;
        for (std::size_t cell = 0; cell < engine.state().radius_um.size(); ++cell)
            run.end.volume_um3.push_back(
                enclosed_volume(mesh.triangles, std::span(x).subspan(cell * n, n)));
    }
    return run;
}

scene::Scene with_report_fields(const scene::Scene& scene) {
    scene::Scene changed = scene;
    changed.pictures.clear();
    changed.measures.fields.clear();
    for (const char* name : {"gamma_eff", "sigma_h"})
        if (has_part_of(scene, *find_field(name))) changed.measures.fields.emplace_back(name);
    return changed;
}

scene::Scene with_fixed_outputs(const scene::Scene& scene, int n_outputs) {
    SPHEROSCOPE_ASSERT(n_outputs > 0 && (n_outputs & (n_outputs - 1)) == 0,
                       "a power of two divides a duration exactly");
    if (scene.cells.arrangement == scene::Arrangement::file)
        throw Error(scene.cells.loc,
                    "wanted cells that the scene itself makes, got cells of a file",
                    "give their centres");
    scene::Scene changed = with_report_fields(scene);
    for (scene::Stage& stage : changed.stages) {
        const bool ends_on_a_condition =
            stage.kind == scene::StageKind::compact || stage.until != scene::Until::duration;
        if (ends_on_a_condition)
            throw Error(stage.loc,
                        "wanted stages of given length, got one that ends on a condition; methods "
                        "would be compared at different times",
                        "use until = \"duration\", and no compaction");
        stage.every_s = 0.0;
        stage.frames = 0;
    }
    scene::Stage& last = changed.stages.back();
    if (last.kind == scene::StageKind::anneal)
        throw Error(last.loc, "wanted a last stage in which cells move, got one of beads",
                    "add a stage of kind \"relax\"");
    last.every_s = last.duration_s / n_outputs;
    return changed;
}

double edge_um(const scene::Scene& scene) {
    double radius_um = scene.cells.radius.shape * scene.cells.radius.scale_um;
    if (scene.cells.radius.fixed_um) radius_um = *scene.cells.radius.fixed_um;
    if (!scene.cells.centres_um.empty()) {
        radius_um = scene.cells.centres_um.front()[3];
        for (const auto& row : scene.cells.centres_um) radius_um = std::min(radius_um, row[3]);
    }
    const Model model = make_model(make_icosphere(scene.cells.nodes), {radius_um});
    return radius_um *
           *std::min_element(model.unit_edge_length.begin(), model.unit_edge_length.end());
}

}  // namespace spheroscope::reports
