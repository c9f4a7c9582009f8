#pragma once

#include "engine/base/error.hpp"
#include "engine/cli/command_line.hpp"
#include "engine/reports/plot.hpp"

#include <functional>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// How the program was called, for those who write it into their results.
struct Invocation {
    std::string command_line;  ///< ready to be pasted into a shell
    std::string version{};     ///< of the program, with commit
};

/// What a verb does once its arguments have been read. A user's mistake is thrown as Error.
using VerbAction = std::function<ExitCode(const Invocation&)>;

/// One row of the table of verbs. A new verb is a new file and one row; `--help`, the proposals for
/// a mistyped verb and the tests loop over the table.
struct Verb {
    std::string name;
    std::string summary;  ///< one line, what the verb does and what comes out

    /// Declares the verb's arguments on its command line. The action owns what they write into.
    std::function<VerbAction(CommandLine&)> declare;
};

/// The verbs that need the engine alone; pictures have their own (render/verbs.hpp). `draw` is for
/// their plots; empty in a program without pictures.
[[nodiscard]] std::vector<Verb> engine_verbs(const reports::DrawPlot& draw);

// One file verb_<name>.cpp each.
[[nodiscard]] Verb bench_verb();
[[nodiscard]] Verb check_verb();
[[nodiscard]] Verb info_verb();
[[nodiscard]] Verb precision_verb(const reports::DrawPlot& draw);
[[nodiscard]] Verb pull_off_verb(const reports::DrawPlot& draw);
[[nodiscard]] Verb reproduce_verb();
[[nodiscard]] Verb run_verb();
[[nodiscard]] Verb scenes_verb();
[[nodiscard]] Verb stability_verb(const reports::DrawPlot& draw);

}  // namespace spheroscope::cli
