#pragma once

#include <span>
#include <string>
#include <vector>

namespace spheroscope::viewer {

/// Which frame is shown, and how that changes: by keys, by a typed time, by playing. Knows no
/// pictures and no clock.
class Playback {
  public:
    /// Frames come in order; the first is shown. While the last one is shown on purpose
    /// (follow_end), a new one is shown at once.
    void add_frame(double time_s);

    [[nodiscard]] int n_frames() const { return static_cast<int>(time_s_.size()); }
    [[nodiscard]] std::span<const double> time_s() const { return time_s_; }
    /// -1: there is none yet.
    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] bool is_playing() const { return is_playing_; }
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] bool follows_end() const { return follows_end_; }

    /// At the last frame playing begins anew at the first.
    void toggle_playing();
    /// The last frame, now and when others come.
    void follow_end();
    /// Frames to go on; stops at either end. Any choice of a frame ends the playing.
    void step(int n_frames);
    void go_to(int frame);
    /// The frame nearest to a time.
    void go_to_time(double time_s);
    /// Over the frame rate of movies. Precondition: > 0.
    void set_speed(double speed) { speed_ = speed; }

    /// Wall time goes by: frames too slow to draw are skipped, so that the speed is what it says.
    void advance(double wall_s, double frames_per_s);

  private:
    std::vector<double> time_s_;
    int frame_ = -1;
    bool is_playing_ = false, follows_end_ = false;
    double speed_ = 1.0;
    double part_of_frame_ = 0.0;  // 0..1 of the way to the next one
};

/// "12.5", "12.5 s", "350 ms", "2 min" in s. Throws Error that says what was wanted.
[[nodiscard]] double parse_time_s(const std::string& text);

}  // namespace spheroscope::viewer
