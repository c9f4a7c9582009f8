#include "render/movie_frames.hpp"

#include "engine/scene/shots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

std::vector<MovieFrame> movie_frames(const scene::Picture& picture,
                                     std::span<const double> time_s) {
    const int n_frames = static_cast<int>(time_s.size());
    const auto progress = [n_frames](int frame) {
        return n_frames > 1 ? static_cast<double>(frame) / (n_frames - 1) : 0.0;
    };
    std::vector<scene::Shot> shots = scene::parse_shots(picture);
    if (shots.empty()) shots.push_back({scene::Shot::Kind::play, INFINITY, 0, 0, false});

    std::vector<MovieFrame> result;
    MovieFrame now;
    int next = 0;  // frame that has not been played yet
    for (const scene::Shot& shot : shots) switch (shot.kind) {
        case scene::Shot::Kind::play:
            for (; next < n_frames && time_s[static_cast<std::size_t>(next)] <= shot.until_s;
                 ++next) {
                now.frame = next;
                now.progress = progress(next);
                result.push_back(now);
            }
            break;
        case scene::Shot::Kind::freeze: {
            const int n = std::max(1, static_cast<int>(std::lround(shot.movie_s * picture.fps)));
            const double from_deg = now.turned_deg;
            for (int k = 1; k <= n; ++k) {
                now.turned_deg = from_deg + shot.orbit_deg * k / n;
                result.push_back(now);
            }
            break;
        }
        case scene::Shot::Kind::cutaway: now.cutaway = shot.has_cutaway; break;
        }
    return result;
}

std::vector<std::string> shots_beyond_the_end(const scene::Picture& picture, double last_time_s) {
    // As written: a last output may miss its round time by the rounding of a sum of steps.
    const double slack_s = 1e-6 * std::max(1.0, std::abs(last_time_s));
    std::vector<std::string> remarks;
    for (const scene::Shot& shot : scene::parse_shots(picture))
        if (shot.kind == scene::Shot::Kind::play && std::isfinite(shot.until_s) &&
            shot.until_s > last_time_s + slack_s)
            remarks.push_back(
                fmt::format("picture '{}': a shot plays to {:g} s, and the run ends at {:g} s",
                            picture.name, shot.until_s, last_time_s));
    return remarks;
}

std::vector<int> frames_beside(std::span<const double> time_s,
                               std::span<const double> other_time_s) {
    const int n_other = static_cast<int>(other_time_s.size());
    std::vector<int> result;
    int other = 0, n_at_zero = 0;
    while (n_at_zero < n_other && other_time_s[static_cast<std::size_t>(n_at_zero)] <= 0.0)
        ++n_at_zero;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        if (time_s[i] <= 0.0) {
            other = std::clamp(static_cast<int>(i), 0, std::max(0, n_at_zero - 1));
        } else {
            other = std::max(other, n_at_zero - 1);
            // Two runs of one schedule meet their outputs up to rounding.
            const double until_s = time_s[i] * (1.0 + 1e-9);
            while (other + 1 < n_other &&
                   other_time_s[static_cast<std::size_t>(other) + 1] <= until_s)
                ++other;
        }
        result.push_back(other);
    }
    return result;
}

}  // namespace spheroscope::render
