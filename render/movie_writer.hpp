#pragma once

#include "render/image.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace spheroscope::render {

/// Encodes pictures into an MP4 (H.264) with the ffmpeg program, raw frames through a socket. A
/// thread inside feeds ffmpeg, so that drawing goes on meanwhile. The file is complete or absent:
/// it is written under a temporary name and renamed by `finish`.
class MovieWriter {
  public:
    /// A named part of the movie, from its first picture to that of the next chapter.
    struct Chapter {
        int first_picture = 0;
        std::string title;
    };
    struct Settings {
        std::filesystem::path path;
        int width_px = 0, height_px = 0;
        double fps = 30.0;
        std::string title, comment, description;  ///< the file's metadata
        std::vector<Chapter> chapters;            ///< ascending; the first begins at picture 0
        int n_pictures = 0;                       ///< where the last chapter ends
    };

    /// Throws Error: odd sizes (usage), no ffmpeg (environment).
    explicit MovieWriter(const Settings& settings);
    /// Without finish(): ends ffmpeg and leaves no file.
    ~MovieWriter();
    MovieWriter(const MovieWriter&) = delete;
    MovieWriter& operator=(const MovieWriter&) = delete;

    /// Waits while k_queue pictures are still to be encoded. Throws Error (environment) with
    /// ffmpeg's own words when ffmpeg has died. Precondition: the size of the settings.
    void add(Image image);
    /// Waits for ffmpeg and gives the movie its name. Throws like add.
    void finish();

    static constexpr std::size_t k_queue = 4;

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

/// The metadata as ffmpeg reads it (its format ffmetadata): title, comment, description, chapters.
[[nodiscard]] std::string metadata_text(const MovieWriter::Settings& settings);

/// Throws Error (usage) unless both sides are even, which the movie's colour format needs.
void check_movie_size(int width_px, int height_px);

}  // namespace spheroscope::render
