#include "engine/cli/frame_choice.hpp"

#include "engine/base/error.hpp"
#include "engine/cli/log.hpp"
#include "engine/scene/time_text.hpp"
#include "engine/scene/units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace spheroscope::cli {
namespace {

/// Times are written with a few digits: what is beyond the last frame by less is that frame.
constexpr double k_resolution_s = 1e-6;

double time_s(const std::string& text) {
    const scene::Quantity time = scene::parse_time(text);
    if (!time.ok())
        throw Error(fmt::format("--time wants a time, got \"{}\" {}", text, time.problem),
                    "for instance --time 3.2 or --time '3.2 s'");
    return time.value;
}

}  // namespace

int FrameChoice::number(const RunFileReader& reader) const {
    const int n = reader.n_frames();
    if (n == 0)
        throw Error(reader.path() + ": the run has no frames yet",
                    "its first one comes with the first output");
    if (frame && !time.empty())
        throw Error("--frame and --time exclude each other", "each of them says which frame");
    if (frame) {
        const int number = *frame < 0 ? n + *frame : *frame;
        if (number < 0 || number >= n)
            throw Error(fmt::format("{}: there is no frame {}", reader.path(), *frame),
                        fmt::format("frames are 0 to {}, or -1 for the last", n - 1));
        return number;
    }
    if (time.empty()) return n - 1;
    const double wanted_s = time_s(time);
    if (!(wanted_s >= reader.time(0) - k_resolution_s &&
          wanted_s <= reader.time(n - 1) + k_resolution_s))
        throw Error(
            fmt::format("{}: there is no frame near t = {:g} s", reader.path(), wanted_s),
            fmt::format("frames go from t = {:g} s to {:g} s", reader.time(0), reader.time(n - 1)));
    // Of frames at the same time (seeding has no model time) the last one.
    int nearest = 0;
    for (int i = 1; i < n; ++i)
        if (std::abs(reader.time(i) - wanted_s) <= std::abs(reader.time(nearest) - wanted_s))
            nearest = i;
    if (std::abs(reader.time(nearest) - wanted_s) > k_resolution_s)
        log_info(fmt::format("frame {}, t = {:g} s, is the nearest to t = {:g} s", nearest,
                             reader.time(nearest), wanted_s));
    return nearest;
}

void add_frame_options(CommandLine& command, FrameChoice& choice) {
    command.option("--frame", choice.frame, "frame to look at, from 0; -1 is the last (default)");
    command.option("--time", choice.time,
                   "model time to look at, for instance '3.2 s': the frame "
                   "nearest to it",
                   {"TIME"});
}

}  // namespace spheroscope::cli
