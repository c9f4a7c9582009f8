#include "engine/stages/bead_packing.hpp"
#include "engine/stages/jamming.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

namespace spheroscope {
namespace {

// C-27, O'Hern et al. 2003: without friction, beads jam at 0.64 to 0.65, just rigid (6 contacts per
// bead that holds something), and contacts in excess of 6 grow as the square root of compression.
void expect_jamming_of_soft_spheres(const std::vector<double>& radius, std::uint64_t seed) {
    const JammingRun run = decompress_to_jamming(radius, 0.665, 1e-5, seed);
    EXPECT_GT(run.jamming_fraction, 0.635);
    EXPECT_LT(run.jamming_fraction, 0.650);
    EXPECT_GT(run.settled.back().coordination, 5.9);
    EXPECT_LT(run.settled.back().coordination, 6.1);
    EXPECT_LT(run.settled.back().rattlers, 0.08);

    // One packing of 1000 beads scatters by 0.1 (O'Hern et al. average many); a law that is linear
    // in the distance would give 1, contacts that stay would give 0.
    EXPECT_NEAR(coordination_exponent(run), 0.5, 0.15);
}

TEST(PeriodicBeads, OfTheCellsSizesJamAsSoftSpheresDo) {
    expect_jamming_of_soft_spheres(draw_radii({}, 1000, 1), 1);
}

TEST(PeriodicBeads, OfTwoSizesJamAsSoftSpheresDo) {
    std::vector<double> radius;
    for (int i = 0; i < 1000; ++i) radius.push_back(i % 2 == 0 ? 1.0 : 1.4);
    expect_jamming_of_soft_spheres(radius, 1);
}

struct Spheroid {
    int n_beads;
    std::uint64_t seed;
};
std::ostream& operator<<(std::ostream& out, const Spheroid& s) {
    return out << s.n_beads << "BeadsSeed" << s.seed;
}
class FullAnnealing : public testing::TestWithParam<Spheroid> {};

TEST_P(FullAnnealing, PacksASpheroidAtTheDefaultFraction) {
    const auto [n_beads, seed] = GetParam();
    BeadPacking packing(draw_radii({}, n_beads, seed), {}, seed);
    while (!packing.is_finished()) packing.advance(1000);
    const PackingOutcome outcome = packing.outcome();
    EXPECT_EQ(outcome.verdict, PackingVerdict::packed) << outcome.reason;
    // Denser than beads at a curved wall like to be, but less so the larger the spheroid.
    EXPECT_LT(outcome.mean_overlap, n_beads >= 600 ? 0.004 : 0.012);
    EXPECT_LT(outcome.largest_overlap, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FullAnnealing,
                         testing::Values(Spheroid{150, 1}, Spheroid{150, 2}, Spheroid{150, 3},
                                         Spheroid{150, 4}, Spheroid{600, 1}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace spheroscope
