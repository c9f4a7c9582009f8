#include "engine/base/team_choice.hpp"

#include <algorithm>

namespace spheroscope {

void TeamChoice::window(double wall_s, double cpu_s) {
    const double got = cpu_s / wall_s;
    if (is_together_) {
        if (got / k_cost_of_team >= alone_) {
            pause_s_ = k_shortest_pause_s;
            alone_ = std::min(1.0, alone_ + wall_s / k_longest_pause_s);
            return;
        }
        is_together_ = false;
        waited_s_ = 0.0;
        return;
    }
    alone_ = std::min(1.0, got);
    waited_s_ += wall_s;
    if (waited_s_ < pause_s_) return;
    is_together_ = true;
    pause_s_ = std::min(2.0 * pause_s_, k_longest_pause_s);
}

}  // namespace spheroscope
