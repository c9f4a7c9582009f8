#include "viewer/run_survey.hpp"

#include "engine/run/aggregate_shape.hpp"
#include "render/movie.hpp"

#include <algorithm>

namespace spheroscope::viewer {
namespace {

/// A frame that cannot be read has the extent of the one before, and the first ones that of the
/// first that can: the scale does not see them.
void add_extent(std::vector<double>& extent_um, double next_um) {
    if (!extent_um.empty() && extent_um.front() == 0.0)
        std::fill(extent_um.begin(), extent_um.end(), next_um);
    extent_um.push_back(next_um);
}

void repeat_extent(std::vector<double>& extent_um) {
    extent_um.push_back(extent_um.empty() ? 0.0 : extent_um.back());
}

}  // namespace

RunSurvey::RunSurvey(const RunHeader& header) {
    for (const Field* field : header.fields) finders_.emplace_back(*field);
}

void RunSurvey::add(const Snapshot& snapshot) {
    if (render::shows_field(snapshot)) {
        has_mechanics_ = true;
        for (std::size_t f = 0; f < finders_.size(); ++f) finders_[f].add(snapshot.fields[f]);
    }
    time_s_.push_back(snapshot.time_s);
    add_extent(extent_um_, render::shown_extent_um(snapshot, {}));
    add_extent(cells_extent_um_, aggregate_extent_um(snapshot));
    summaries_.push_back(summary_of(snapshot));
}

void RunSurvey::add_unreadable(double time_s) {
    time_s_.push_back(time_s);
    repeat_extent(extent_um_);
    repeat_extent(cells_extent_um_);
}

render::View RunSurvey::view_of(const Snapshot& snapshot, const scene::Picture& picture,
                                int n_frames) const {
    render::View view;
    // While frames are still missing a range of those that are there would change under the eye.
    const bool knows_all = this->n_frames() == n_frames;
    if (knows_all && n_frames > 0 && snapshot.frame < n_frames) {
        // A look between frames has the scale of the last one.
        const int frame = snapshot.frame < 0 ? n_frames - 1 : snapshot.frame;
        view.fit_radius_um =
            render::fit_radii(picture.exploded > 0.0 ? cells_extent_um_ : extent_um_,
                              picture.fps)[static_cast<std::size_t>(frame)];
    }
    view.progress = n_frames > 1 && snapshot.frame >= 0
                        ? static_cast<double>(snapshot.frame) / (n_frames - 1)
                        : 0.0;
    view.time_decimals = render::time_decimals(time_s_);
    const int field = render::find_picture_field(*snapshot.header, picture);
    if (field >= 0 && picture.range == "given")
        view.range = render::Range{picture.given_range[0], picture.given_range[1]};
    // A look at a run that has only beads so far has its own range.
    if (knows_all && picture.range == "run" && (has_mechanics_ || snapshot.frame >= 0))
        view.range =
            field < 0 ? render::Range{} : finders_[static_cast<std::size_t>(field)].range();
    return view;
}

}  // namespace spheroscope::viewer
