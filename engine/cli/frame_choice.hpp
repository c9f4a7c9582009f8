#pragma once

#include "engine/cli/command_line.hpp"
#include "engine/store/run_file.hpp"

#include <optional>
#include <string>

namespace spheroscope::cli {

/// Which frame of a run's file a verb looks at.
struct FrameChoice {
    std::optional<int> frame;  ///< as given; negative ones count from the end
    std::string time;          ///< as given, "3.2 s" or "3.2"; empty: none

    /// Number of the frame; the last one when nothing was given, the nearest one to a time. Throws
    /// Error (usage): no such frame, a time outside the run, both given, a run without frames.
    [[nodiscard]] int number(const RunFileReader& reader) const;
};

/// Declares --frame and --time; `choice` must live until it is read.
void add_frame_options(CommandLine& command, FrameChoice& choice);

}  // namespace spheroscope::cli
