#pragma once

#include "engine/cli/options.hpp"
#include "engine/cli/verb.hpp"
#include "engine/run/engine.hpp"
#include "engine/run/expectations.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// Where a run's results go: <folder>/run.h5 and, beside it, its checkpoints and the .xdmf.
struct RunPlace {
    std::string folder;
    [[nodiscard]] std::string run_file() const { return folder + "/run.h5"; }
};
/// --output, or out/<scene's name>.
[[nodiscard]] RunPlace run_place(const std::string& scene_file, const CommonOptions& options);

struct SimulationSummary {
    RunResult result;
    std::vector<Expectation> expectations;
    std::string contact_arithmetic;  ///< RunHeader::contact_arithmetic; empty if nothing was run
    std::optional<std::uint64_t> state_hash;  ///< none: the file of a finished run does not say it
    ExitCode code = ExitCode::ok;
};

/// Simulates a scene into its place: the engine in its own thread, the store in another one, both
/// joined before this returns. SIGINT and SIGTERM end the step in progress and leave a checkpoint.
/// With options.resume the run goes on from its newest checkpoint. Throws Error when it cannot
/// begin: an unfinished run, or a finished one of another scene, is never overwritten unless
/// `overwrite`.
/// `changes` are made on the way; those and what `live` changes are recorded in the run's file. A
/// resumed run makes the changes that its file holds.
[[nodiscard]] SimulationSummary simulate(const scene::Scene& scene, const RunPlace& place,
                                         const CommonOptions& options, bool overwrite,
                                         const Invocation& invocation,
                                         const std::vector<Change>& changes = {},
                                         LiveControl* live = nullptr);

/// Cells of a frame of an earlier run, for `arrangement = "file"`; none otherwise. Throws Error, at
/// the scene's line, when they cannot be had.
[[nodiscard]] std::optional<GivenCells> given_cells(const scene::Scene& scene);

/// Throws Error for a scene that comes from a run's file or a picture (`where`) and begins with the
/// cells of another run: their path is relative to the scene's folder, which neither knows, and
/// where this program was called there may be others.
void refuse_cells_beside_a_scene(const scene::Scene& scene, const std::string& where,
                                 const std::string& hint);

/// Whether a stored run is of this scene and seed. Only what the engine reads counts: other
/// pictures are the same run.
[[nodiscard]] bool is_run_of(const scene::Scene& scene, const RunHeader& stored);

/// Whether this very program has made the stored run. Two programs that differ from a commit, each
/// in its way, have the same version ("+changes"), so of such a one it is never said.
[[nodiscard]] bool is_made_by_this_program(const RunHeader& stored);

/// Throws Error where a run of this scene with these changes would take the place of an unfinished
/// run, of one of another scene or seed, or of one that was changed in another way.
void check_nothing_is_lost(const RunPlace& place, const scene::Scene& scene,
                           const std::vector<Change>& changes);

/// The summary for people, and for scripts.
[[nodiscard]] std::string summary_text(const SimulationSummary& summary, const RunPlace& place);
[[nodiscard]] nlohmann::json summary_json(const SimulationSummary& summary, const RunPlace& place);

}  // namespace spheroscope::cli
