#include "viewer/model/playback.hpp"

#include "engine/base/error.hpp"
#include "engine/scene/time_text.hpp"
#include "engine/scene/units.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::viewer {

void Playback::add_frame(double time_s) {
    time_s_.push_back(time_s);
    if (frame_ < 0 || follows_end_) frame_ = n_frames() - 1;
}

void Playback::toggle_playing() {
    if (n_frames() == 0) return;
    is_playing_ = !is_playing_;
    follows_end_ = false;
    part_of_frame_ = 0.0;
    if (is_playing_ && frame_ == n_frames() - 1) frame_ = 0;
}

void Playback::follow_end() {
    go_to(n_frames() - 1);
    follows_end_ = true;
}

void Playback::step(int n_frames) { go_to(frame_ + n_frames); }

void Playback::go_to(int frame) {
    is_playing_ = follows_end_ = false;
    if (n_frames() > 0) frame_ = std::clamp(frame, 0, n_frames() - 1);
}

void Playback::go_to_time(double time_s) {
    if (n_frames() == 0) return;
    const auto nearest = std::min_element(time_s_.begin(), time_s_.end(), [&](double a, double b) {
        return std::abs(a - time_s) < std::abs(b - time_s);
    });
    go_to(static_cast<int>(nearest - time_s_.begin()));
}

void Playback::advance(double wall_s, double frames_per_s) {
    if (!is_playing_) return;
    part_of_frame_ += wall_s * frames_per_s * speed_;
    const double whole = std::floor(part_of_frame_);
    part_of_frame_ -= whole;
    const double wanted = frame_ + whole;
    frame_ = static_cast<int>(std::min<double>(wanted, n_frames() - 1));
    if (frame_ == n_frames() - 1) is_playing_ = false;
}

double parse_time_s(const std::string& text) {
    const scene::Quantity time = scene::parse_time(text);
    if (time.ok()) return time.value;
    throw Error("wanted a time such as 12.5 s or 2 min, got \"" + text + "\"");
}

}  // namespace spheroscope::viewer
