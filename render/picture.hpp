#pragma once

#include "engine/run/snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "render/camera.hpp"
#include "render/image.hpp"
#include "render/range.hpp"

#include <memory>
#include <optional>
#include <string>

namespace spheroscope::render {

/// Whether cells are coloured by the picture's field in this frame. While beads are being seeded
/// there is no mechanics that a field could show: cells are plain then.
[[nodiscard]] bool shows_field(const Snapshot& snapshot);

/// How a picture is drawn: `full` is what movies have; `draft` has one drawn pixel for each of the
/// picture and jagged edges, for frames that follow each other; `coarse` one for four, for views
/// that are being turned by hand. Writing is the same in all.
enum class Quality { full, draft, coarse };

/// What changes from frame to frame besides the snapshot.
struct View {
    /// Half the height that the aggregate is given; the caller passes the largest extent of a
    /// movie, so that the scale stays. Unset: this frame's extent.
    std::optional<double> fit_radius_um{};
    /// Unset: the scene's given range, or the range of this frame.
    std::optional<Range> range{};
    double progress = 0.0;    ///< 0..1 through the movie: how far the picture's orbit has turned
    double turned_deg = 0.0;  ///< besides: by the shots of a movie
    std::optional<bool> cutaway{};  ///< unset: the picture's
    int time_decimals = 1;
    std::string heading{};  ///< instead of the run's title; "": the title
    Quality quality = Quality::full;
};

/// Half the extent that the picture makes room for, before cells are pulled apart: of the cells,
/// and of the bead where one acts and is drawn.
[[nodiscard]] double shown_extent_um(const Snapshot& snapshot, const scene::Picture& picture);

/// Turns snapshots of one run into pictures, one view of the scene. Pictures are the same bits for
/// the same input. One thread makes, uses and destroys it.
class Renderer {
  public:
    /// Throws Error when the picture wants a field, or axes, that the run does not hold, has a bad
    /// size or an empty range (usage), or when nothing can be drawn here (environment).
    /// `difference` is written below the title: what tells this run from those beside it.
    Renderer(std::shared_ptr<const RunHeader> header, const scene::Picture& picture,
             std::string difference = "");
    ~Renderer();

    /// Another picture of the same run from now on. Throws like the constructor, with nothing
    /// changed.
    void set_picture(const scene::Picture& picture);

    /// Precondition: the snapshot has this run's cells and fields, at least one cell, finite
    /// positions.
    [[nodiscard]] Image render(const Snapshot& snapshot, const View& view);

    /// The view of that picture: where a point of space is in it.
    [[nodiscard]] Camera camera(const Snapshot& snapshot, const View& view) const;
    /// OsmesaContext::description of what draws here.
    [[nodiscard]] std::string drawn_with();
    /// The field that is shown; nullptr for plain cells. Its index in Snapshot::fields:
    /// field_index().
    [[nodiscard]] const Field* field() const;
    [[nodiscard]] int field_index() const;
    [[nodiscard]] const scene::Picture& picture() const;

  private:
    [[nodiscard]] Image draw(const Snapshot& snapshot, const View& view);

    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

/// Whether a run holds what `stress_axes` draws.
[[nodiscard]] bool holds_stress_axes(const RunHeader& header);

/// The field of a picture in a run: its index, or -1 for plain cells. Throws Error (usage) when the
/// run does not hold it.
[[nodiscard]] int find_picture_field(const RunHeader& header, const scene::Picture& picture);

}  // namespace spheroscope::render
