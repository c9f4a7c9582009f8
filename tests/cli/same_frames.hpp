#pragma once

#include "engine/run/snapshot.hpp"
#include "engine/store/run_file.hpp"

#include <string>

namespace spheroscope {

/// "" if the frames are equal to the bit, else what differs first.
[[nodiscard]] std::string difference(const Snapshot& a, const Snapshot& b);

/// "" if the first `n` frames of both runs are equal to the bit, else which one differs in what.
[[nodiscard]] std::string difference(const RunFileReader& a, const RunFileReader& b, int n);

}  // namespace spheroscope
