#pragma once

#include "engine/scene/scene.hpp"

#include <vector>

namespace spheroscope::scene {

/// One step of a movie. The words of `picture.shots`, each an entry of the list:
///
///     "play to 12 s"                  the frames up to that model time, one picture each
///     "play to end"                   all that are left
///     "freeze 2 s"                    the frame stands for two seconds of movie
///     "freeze 4 s, orbit 360 deg"     meanwhile the view turns, evenly, and stays turned
///     "cutaway on", "cutaway off"     from here on, whatever picture.cutaway says
struct Shot {
    enum class Kind { play, freeze, cutaway };
    Kind kind = Kind::play;
    double until_s = 0.0;     ///< play: model time; infinite for the end
    double movie_s = 0.0;     ///< freeze: how long
    double orbit_deg = 0.0;   ///< freeze: how far
    bool has_cutaway = true;  ///< cutaway
};

/// The shots of a picture, in order. Throws Error with the picture's place for words that are none
/// of the above, for a time that goes back, and for a list that plays nothing.
[[nodiscard]] std::vector<Shot> parse_shots(const Picture& picture);

}  // namespace spheroscope::scene
