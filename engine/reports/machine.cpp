#include "engine/reports/machine.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <limits>
#include <thread>
#include <unistd.h>

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

double resident_MB() {
    std::ifstream file("/proc/self/statm");
    double all_pages = 0.0, resident_pages = 0.0;
    if (!(file >> all_pages >> resident_pages)) return std::numeric_limits<double>::quiet_NaN();
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace spheroscope::reports
