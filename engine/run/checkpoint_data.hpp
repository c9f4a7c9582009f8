#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace spheroscope {

/// Everything that a run needs to go on, as named arrays; what the names mean is the engine's
/// business. Names must not contain '/'. Every bit comes back as it was: -0, denormals, the payload
/// of a NaN.
struct CheckpointData {
    std::map<std::string, std::vector<double>> float64;
    std::map<std::string, std::vector<std::int64_t>> int64;
    std::map<std::string, std::string> text;
};

}  // namespace spheroscope
