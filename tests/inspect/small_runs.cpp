#include "tests/inspect/small_runs.hpp"

#include "tests/scene/case_a_text.hpp"

namespace spheroscope::test {

std::string text_of(const PairScene& pair) {
    const std::string half = std::to_string(0.5 * pair.centre_distance_um);
    return "[cells]\narrangement = \"centres\"\nnodes = " + std::to_string(pair.nodes) +
           "\ncentres = [[0, 0, -" + half + ", 9], [0, 0, " + half + ", 9]" + pair.cells +
           R"(]
)" + k_case_a_cell +
           "[cortex.bending]\n" + case_a_contact("law = \"" + pair.law + "\"\n") + R"([method]
dt_max = "0.05 s"
)" + pair.stages +
           "[measures]\nfields = [\"sigma_nn\"]\n" + pair.extra;
}

SmallRun run_scene_text(const std::string& text) {
    const scene::Scene scene = scene::parse_scene(text, "small.toml");
    Engine engine(scene, {.threads = 1, .version = {}, .command_line = {}});
    return run_engine(engine);
}

SmallRun run_engine(Engine& engine) {
    SmallRun run;
    EngineSinks sinks;
    sinks.frame = [&](SnapshotPtr frame) -> std::optional<std::string> {
        run.frames.push_back(std::move(frame));
        return {};
    };
    const std::atomic<bool> stop{false};
    static_cast<void>(engine.run(sinks, stop));
    run.header = engine.header();
    return run;
}

}  // namespace spheroscope::test
