#pragma once

#include <cstdint>

namespace spheroscope {

/// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011, through Random123): the value
/// is a pure function of (seed, stream, index, component). There is no state to save, and the order
/// in which threads ask does not matter.
class Random {
  public:
    Random(std::uint64_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}

    /// Uniform in (0, 1).
    [[nodiscard]] double uniform(std::uint64_t index, std::uint32_t component = 0) const;
    /// Standard normal (Box-Muller).
    [[nodiscard]] double normal(std::uint64_t index, std::uint32_t component = 0) const;

  private:
    std::uint64_t seed_;
    std::uint32_t stream_;
};

/// One stream per use, so that adding a use does not change the numbers of another.
enum class RandomStream : std::uint32_t {
    cell_radius = 1,
    bead_start = 2,
    bead_noise = 3,
    probe = 4,
    orientation = 5,
    fastest_mode = 6,
    bootstrap = 7,
    turn = 8,
};

}  // namespace spheroscope
