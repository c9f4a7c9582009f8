#pragma once

#include "engine/scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spheroscope::render {

/// One picture of a movie: which frame of the run, and what the shots do to the view.
struct MovieFrame {
    int frame = 0;
    double progress = 0.0;        ///< 0..1 through the run's frames
    double turned_deg = 0.0;      ///< by the shots so far
    std::optional<bool> cutaway;  ///< set by a shot
};

/// The pictures of a movie in order. time_s: of each frame of the run, not descending, at least
/// one. Without shots every frame is shown once. A shot that plays to a time before the next frame
/// plays nothing; one that freezes before anything was played shows the first frame. Throws Error
/// (usage) as scene::parse_shots does.
[[nodiscard]] std::vector<MovieFrame> movie_frames(const scene::Picture& picture,
                                                   std::span<const double> time_s);

/// What of the shots cannot be seen since the run ends before: a line for each shot that plays to a
/// later time.
[[nodiscard]] std::vector<std::string> shots_beyond_the_end(const scene::Picture& picture,
                                                            double last_time_s);

/// For each frame of the first run, the frame of the other that is shown beside it: the last one
/// that is not later. Frames of seeding all have time 0; they go by their number.
[[nodiscard]] std::vector<int> frames_beside(std::span<const double> time_s,
                                             std::span<const double> other_time_s);

}  // namespace spheroscope::render
