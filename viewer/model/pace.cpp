#include "viewer/model/pace.hpp"

#include <limits>

namespace spheroscope::viewer {
namespace {

constexpr double k_recent_s = 2.0;

double ratio(double model_s, double wall_s) {
    return wall_s > 0.0 ? model_s / wall_s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void Pace::see(double model_s, double wall_s) {
    if (!recent_.empty()) {
        model_s_ += model_s - recent_.back().first;
        wall_s_ += wall_s - recent_.back().second;
    }
    recent_.emplace_back(model_s, wall_s);
    while (wall_s - recent_.front().second > k_recent_s && recent_.size() > 2) recent_.pop_front();
}

double Pace::recent() const {
    if (recent_.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    return ratio(recent_.back().first - recent_.front().first,
                 recent_.back().second - recent_.front().second);
}

double Pace::overall() const { return ratio(model_s_, wall_s_); }

}  // namespace spheroscope::viewer
