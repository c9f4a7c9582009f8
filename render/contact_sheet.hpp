#pragma once

#include "engine/inspect/contact_story.hpp"
#include "render/image.hpp"
#include "render/png.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace spheroscope::render {

/// Draws one contact as a sheet of 1600 x 1000 pixels, the same ranges in all frames:
///
///   title: cells, frame, time, scene
///   +-----------------+------------------+-----------+
///   | the two cells,  | pressure map in  | numbers   |
///   | pulled apart:   | the contact plane| with units|
///   | A's face        +------------------+-----------+
///   +-----------------+ P along a line   | force(t)  |
///   | B's face        | against the law  | area(t)   |
///   +-----------------+------------------+-----------+
class ContactSheet {
  public:
    static constexpr int k_width_px = 1600, k_height_px = 1000;

    /// Throws Error (environment) when there is no OpenGL.
    ContactSheet(std::shared_ptr<const RunHeader> header, const inspect::ContactKey& key);
    ~ContactSheet();

    /// What the charts show, and what the ranges are from. Ascending by frames; some may be
    /// missing.
    void set_history(std::vector<inspect::ContactSummary> history);
    /// A moment whose numbers are beyond the history's makes the ranges wider from now on.
    [[nodiscard]] Image draw(const inspect::ContactMoment& moment);
    /// For the texts of a file with the sheet that was drawn last.
    [[nodiscard]] PngTexts texts(const std::string& made_by, const std::string& command) const;

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

/// Writes the sheet of one frame, complete or absent, with what it shows in its texts.
void write_contact_sheet(const inspect::ContactStory& story, int frame,
                         const std::filesystem::path& png);
/// A movie of the sheets of all frames but those of seeding. Throws Error (environment) without
/// ffmpeg.
void write_contact_movie(const inspect::ContactStory& story, const std::filesystem::path& mp4);

}  // namespace spheroscope::render
