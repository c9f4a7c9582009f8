#pragma once

#include "engine/run/engine.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace spheroscope::test {

/// A scene's run, kept in memory.
struct SceneRun {
    scene::Scene scene;
    RunResult result;
    std::vector<SnapshotPtr> frames;

    [[nodiscard]] const Snapshot& last() const { return *frames.back(); }
};

/// The text of scenes/<name>.
[[nodiscard]] std::string scene_text(const std::string& name);

/// All scene files of a folder below scenes/, "claims/drop_laplace.toml", ascending.
[[nodiscard]] std::vector<std::string> scene_files(const std::string& folder);

/// Runs a scene on one thread, like the program does. `max_steps`: stop after so many steps of the
/// cells; 0: run to the end. Throws Error as the program would.
[[nodiscard]] SceneRun run_scene(const scene::Scene& scene, std::int64_t max_steps = 0);
/// The same for scenes/<name>.
[[nodiscard]] SceneRun run_scene(const std::string& name,
                                 const std::vector<scene::Override>& overrides = {},
                                 std::int64_t max_steps = 0);

}  // namespace spheroscope::test
