#pragma once

#include "render/frame_source.hpp"
#include "render/movie_frames.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace spheroscope::render {

/// What the first pass over a run finds.
struct Survey {
    Range range;
    double share_outside = 0.0;
    std::vector<double> fit_radius_um;  ///< for each frame
    int time_decimals = 1;
    std::vector<double> time_s;            ///< of each frame
    std::vector<std::string> stage_names;  ///< of each frame
    std::vector<double> plotted;           ///< of each frame: picture.plot; empty without it
};
[[nodiscard]] Survey survey_frames(FrameSource& frames, const scene::Picture& picture);

/// Key of Renderer::drawn_with among the texts of a picture's file.
inline constexpr const char* k_drawn_with_key = "Drawn with";

/// Paints the pictures of a movie: runs side by side, each with what tells it from the others, and
/// the plot below if the picture asks for one. One thread makes, uses and destroys it. Runs and
/// surveys must live as long.
class MoviePainter {
  public:
    /// runs, surveys: one of each for every part of the picture; a run may be there several times.
    MoviePainter(std::span<FrameSource* const> runs, std::span<const Survey> surveys,
                 const scene::Picture& picture, std::string drawn_by);
    ~MoviePainter();

    /// Lines below the pictures from now on.
    void set_caption(const std::vector<std::string>& lines);

    /// What one run shows.
    struct Shown {
        int frame = 0;
        View view;
    };
    /// What the picture's file says of it; the keys of the second run begin with "Beside: ", those
    /// of a third with that twice. The fingerprint is that of the whole picture.
    [[nodiscard]] PngTexts texts(std::span<const Shown> shown);
    /// The picture. Makes the renderers when it is called first.
    [[nodiscard]] Image paint(std::span<const Shown> shown);
    /// Width and height of the pictures, px.
    [[nodiscard]] std::array<int, 2> size_px() const;

    /// Renderer::drawn_with. Precondition: something has been painted.
    [[nodiscard]] std::string drawn_with();

    static constexpr const char* k_beside = "Beside: ";
    /// Key of the caption among the texts of the picture's file, line by line.
    static constexpr const char* k_caption = "Caption";

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::render
