#pragma once

#include "engine/inspect/contact_history.hpp"
#include "engine/run/engine.hpp"

#include <memory>
#include <string>
#include <vector>

namespace spheroscope::test {

/// A run kept in memory.
struct SmallRun {
    std::shared_ptr<const RunHeader> header;
    std::vector<SnapshotPtr> frames;

    [[nodiscard]] const SnapshotPtr& last() const { return frames.back(); }
    [[nodiscard]] int n_frames() const { return static_cast<int>(frames.size()); }
    [[nodiscard]] inspect::ReadFrame reader() const {
        return [frames = frames](int i) { return frames[static_cast<std::size_t>(i)]; };
    }
};

/// What two spheres of 9 um do; everything of the paper's case A.
struct PairScene {
    int nodes = 162;
    double centre_distance_um = 18.0;
    std::string law = "traction";
    std::string stages = "[[stage]]\nkind = \"relax\"\nduration = 0.2\nevery = 0.1\n";
    std::string cells = "";  ///< more rows of centres, ", [20, 0, 0, 9]"
    std::string extra = "";  ///< more tables
};
[[nodiscard]] std::string text_of(const PairScene& pair);

[[nodiscard]] SmallRun run_scene_text(const std::string& text);
/// To its end.
[[nodiscard]] SmallRun run_engine(Engine& engine);

}  // namespace spheroscope::test
