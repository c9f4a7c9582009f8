#pragma once

#include "engine/scene/scene.hpp"
#include "render/frame_source.hpp"
#include "render/movie_painter.hpp"
#include "render/range.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spheroscope::render {

struct MovieSettings {
    scene::Picture picture;
    std::filesystem::path frames_folder;  ///< 000000.png, 000001.png ...; made if it is not there
    std::filesystem::path movie_path;     ///< the MP4
    bool keeps_pictures = true;           ///< false: no PNGs, the movie only
    std::string drawn_by;                 ///< version of this program, for the files' texts
    std::function<void(int n_done, int n_frames)>
        on_progress;                       ///< after each picture; may be empty
    std::function<bool()> stop_requested;  ///< asked before each picture; may be empty
};

struct MovieResult {
    int n_frames = 0;          ///< pictures of the movie
    int n_done = 0;            ///< that are there; all unless it was stopped
    int n_drawn = 0;           ///< the others were there already, with the same fingerprint
    bool stopped = false;      ///< on request: the pictures so far are there, the movie is not
    Range range;               ///< of the whole movie; of nothing with range = "frame"
    double share_outside = 0;  ///< at most this share of all coloured values lies outside the range
    std::vector<std::string> remarks = {};  ///< what was wanted and is not to be seen
};

/// Makes the pictures of all frames and the movie of them, with one colour range and one scale,
/// which a first pass over the frames finds. Pictures that are there already with the same
/// fingerprint are kept; all others in the folder with names like 000000.png are replaced or
/// removed, so that the folder never holds pictures of two settings. Draws on the calling thread;
/// files and ffmpeg have threads of their own. Throws Error: what Renderer, write_png and
/// MovieWriter throw; no frames (usage). Without ffmpeg all pictures are made first, then the error
/// (environment) is thrown.
MovieResult make_movie(FrameSource& frames, const MovieSettings& settings);
/// The same of two runs side by side: one colour range, one scale, and beside each frame of the
/// first that of the other which is not later. The picture's field must be in both.
MovieResult make_comparison(FrameSource& frames, FrameSource& other, const MovieSettings& settings);

/// Decimals, 1 to 3, with which the times of a run's frames can be written as they are: to a
/// fiftieth of the smallest interval between two of them. Times in ascending order.
[[nodiscard]] int time_decimals(std::span<const double> time_s);

/// The radius that each frame is scaled to, from the extents of all frames. Constant (the largest)
/// while the extents differ by less than a fifth; else it follows them smoothly over about two
/// seconds, never below the extent, so that nothing leaves the picture and nothing becomes tiny.
[[nodiscard]] std::vector<double> fit_radii(std::span<const double> extent_um, double fps);

}  // namespace spheroscope::render
