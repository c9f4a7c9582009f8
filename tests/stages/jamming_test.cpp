#include "engine/stages/bead_packing.hpp"
#include "engine/stages/jamming.hpp"

#include <gtest/gtest.h>

namespace spheroscope {
namespace {

// The small sibling of the check with 1000 beads. 250 beads scatter by 0.002 from seed to seed.
TEST(PeriodicBeads, JamIsostaticallyAtRandomClosePacking) {
    const JammingRun run = decompress_to_jamming(draw_radii({}, 250, 1), 0.665, 1e-5, 1);
    EXPECT_GT(run.jamming_fraction, 0.635);
    EXPECT_LT(run.jamming_fraction, 0.65);
    EXPECT_GT(run.settled.back().coordination, 5.9);
    EXPECT_LT(run.settled.back().coordination, 6.1);
}

}  // namespace
}  // namespace spheroscope
