#include "engine/reports/machine.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <limits>
#include <thread>

namespace spheroscope::reports {

Machine this_machine() {
    Machine machine;
    machine.cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    machine.processor = "unknown";
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) != 0) continue;
        const std::size_t begin = line.find(':');
        if (begin != std::string::npos && begin + 2 < line.size())
            machine.processor = line.substr(begin + 2);
        break;
    }
    return machine;
}

double cpu_clock_s() {
    timespec now{};
    if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) != 0)
        return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_clock_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double allocated_MB() {
    const struct mallinfo2 now = mallinfo2();  // of all threads
    return 1e-6 * static_cast<double>(now.uordblks + now.hblkhd);
}

}  // namespace spheroscope::reports
