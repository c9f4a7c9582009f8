#pragma once

#include "engine/scene/scene.hpp"
#include "render/picture.hpp"
#include "render/range.hpp"
#include "viewer/model/series.hpp"

#include <vector>

namespace spheroscope::viewer {

/// What pictures and plots need to know of all frames of a run, gathered as they come in order:
/// ranges of all fields, extents, the numbers of the whole aggregate. A movie finds the same in its
/// first pass.
class RunSurvey {
  public:
    explicit RunSurvey(const RunHeader& header);

    void add(const Snapshot& snapshot);
    /// The next frame cannot be read: range, scale and numbers are those of the others.
    void add_unreadable(double time_s);

    /// That were added, in either way.
    [[nodiscard]] int n_frames() const { return static_cast<int>(time_s_.size()); }
    [[nodiscard]] int n_unreadable() const {
        return static_cast<int>(time_s_.size() - summaries_.size());
    }
    [[nodiscard]] const std::vector<FrameSummary>& summaries() const { return summaries_; }
    /// The view of one frame in a movie of `n_frames` frames. With range = "run" the range is that
    /// of all frames that were added; with the same frames, pixels are those of the movie.
    [[nodiscard]] render::View view_of(const Snapshot& snapshot, const scene::Picture& picture,
                                       int n_frames) const;

  private:
    std::vector<render::RangeFinder> finders_;  // one for each field
    // With the bead, as pictures show it, and without, as those do that pull the cells apart.
    std::vector<double> extent_um_, cells_extent_um_;
    std::vector<double> time_s_;
    std::vector<FrameSummary> summaries_;
    bool has_mechanics_ = false;
};

}  // namespace spheroscope::viewer
