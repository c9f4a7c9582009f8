// A movie of thousands of frames costs per frame what a movie of fifty does.
#include "render/movie.hpp"
#include "tests/render/drifting_pair.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <unistd.h>
#include <vector>

namespace spheroscope::render {
namespace {

/// Processor time of this thread, which draws; compression and ffmpeg have their own.
double thread_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double resident_MB() {
    long total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// What is left when the disturbances by other programs are taken away: the lower quarter.
double typical(std::vector<double> values) {
    const auto quarter = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
    std::nth_element(values.begin(), quarter, values.end());
    return *quarter;
}

struct Growth {
    double time_ratio, memory_MB;
};

/// One movie: how much more its last frames cost than its first ones.
Growth growth_over(int n_frames, int n_part) {
    const TemporaryFolder folder;
    DriftingPair frames(n_frames, 0.01F, 0.001);
    MovieSettings settings;
    settings.picture = synthetic::make_picture("mean_stress");
    settings.picture.plot = "sigma_h_core";
    settings.frames_folder = folder.path() / "frames";
    settings.movie_path = folder.path() / "a.mp4";
    settings.drawn_by = "test";
    std::vector<double> cpu_s;
    double last_cpu_s = thread_cpu_s(), early_MB = 0.0;
    settings.on_progress = [&](int n_done, int) {
        const double now_s = thread_cpu_s();
        cpu_s.push_back(now_s - last_cpu_s);
        last_cpu_s = now_s;
        if (n_done == n_part) early_MB = resident_MB();
    };
    EXPECT_EQ(make_movie(frames, settings).n_drawn, n_frames);
    const double growth_MB = resident_MB() - early_MB;
    // The very first compiles the shaders.
    const double first_s = typical({cpu_s.begin() + 1, cpu_s.begin() + 1 + n_part});
    const double last_s = typical({cpu_s.end() - n_part, cpu_s.end()});
    std::cout << "first " << n_part << ": " << 1e3 * first_s << " ms per frame, last " << n_part
              << ": " << 1e3 * last_s << " ms, ratio " << last_s / first_s << "; memory growth "
              << growth_MB << " MB\n";
    return {last_s / first_s, growth_MB};
}

// A frame that grows does so in each movie; a processor that other programs slow down in the middle
// of one is at its old pace again in one of the next. Hence the smallest ratio of four.
TEST(LongMovie, HasFlatFrameTimeAndMemoryOver300Frames) {
    double least_ratio = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4 && !(least_ratio < 1.05); ++i) {
        const Growth growth = growth_over(300, 50);
        EXPECT_LT(growth.memory_MB, 5.0);
        least_ratio = std::min(least_ratio, growth.time_ratio);
    }
    EXPECT_LT(least_ratio, 1.05);
}

}  // namespace
}  // namespace spheroscope::render
