#pragma once

namespace spheroscope::scene {

/// visit(key, member) for everything that decides what a picture shows, under the names of the keys
/// of [[picture]]. Not its name; and `fps` and `shots` say which pictures there are, not what is in
/// them.
template <class Picture, class Visit> void visit_shown(Picture& picture, const Visit& visit) {
    visit("field", picture.field);
    visit("size", picture.size_px);
    visit("range", picture.range);
    visit("given_range", picture.given_range);
    visit("cutaway", picture.cutaway);
    visit("network", picture.network);
    visit("stress_axes", picture.stress_axes);
    visit("exploded", picture.exploded);
    visit("azimuth", picture.azimuth_deg);
    visit("elevation", picture.elevation_deg);
    visit("orbit", picture.orbit_deg);
    visit("smooth", picture.smooth);
    visit("plot", picture.plot);
}

}  // namespace spheroscope::scene
