#pragma once

namespace spheroscope::scene {

/// visit(key, members...) for everything that decides what pictures show, under the names of the
/// keys of [[picture]], with the member of each picture. Not its name; and `fps` and `shots` say
/// which pictures there are, not what is in them.
template <class Visit, class... Pictures>
void visit_shown_of(const Visit& visit, Pictures&... picture) {
    visit("field", picture.field...);
    visit("size", picture.size_px...);
    visit("range", picture.range...);
    visit("given_range", picture.given_range...);
    visit("cutaway", picture.cutaway...);
    visit("network", picture.network...);
    visit("stress_axes", picture.stress_axes...);
    visit("exploded", picture.exploded...);
    visit("azimuth", picture.azimuth_deg...);
    visit("elevation", picture.elevation_deg...);
    visit("orbit", picture.orbit_deg...);
    visit("smooth", picture.smooth...);
    visit("plot", picture.plot...);
}

/// The same of one.
template <class Picture, class Visit> void visit_shown(Picture& picture, const Visit& visit) {
    visit_shown_of(visit, picture);
}

}  // namespace spheroscope::scene
