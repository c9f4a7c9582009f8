#include "tests/claims/scene_run.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace spheroscope::test {
namespace {

const std::filesystem::path k_scenes = std::filesystem::path(SPHEROSCOPE_SOURCE_DIR) / "scenes";

}  // namespace

std::string scene_text(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(k_scenes / name).rdbuf();
    return text.str();
}

std::vector<std::string> scene_files(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(k_scenes / folder))
        if (entry.path().extension() == ".toml")
            names.push_back(folder + "/" + entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

SceneRun run_scene(const scene::Scene& scene, std::int64_t max_steps) {
    SceneRun run;
    run.scene = scene;
    EngineOptions options;
    options.threads = 1;
    Engine engine(run.scene, options);
    std::atomic<bool> stop{false};
    EngineSinks sinks;
    sinks.frame = [&](SnapshotPtr frame) -> std::optional<std::string> {
        run.frames.push_back(std::move(frame));
        return {};
    };
    sinks.progress = [&](const RunProgress& progress) {
        if (max_steps > 0 && progress.steps >= max_steps) stop = true;
    };
    run.result = engine.run(sinks, stop);
    return run;
}

SceneRun run_scene(const std::string& name, const std::vector<scene::Override>& overrides,
                   std::int64_t max_steps) {
    return run_scene(scene::load_scene((k_scenes / name).string(), overrides), max_steps);
}

}  // namespace spheroscope::test
