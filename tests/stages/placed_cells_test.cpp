// Cells that become of beads are turned, each by a rotation of its own.
#include "engine/stages/build.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope::test {
namespace {

/// The linear maps that take the nodes of the rest shape to where those of n cells were placed.
std::vector<Mat3> rotations(int n_cells, std::uint64_t seed) {
    const Model model =
        make_model(make_icosphere(42), std::vector<double>(std::size_t(n_cells), 9.0));
    const std::vector<Vec3> centres(std::size_t(n_cells), Vec3(1.0, 2.0, 3.0));
    std::vector<Vec3> x_um(model.n_all_nodes());
    place_cells(model, centres, seed, x_um);
    std::vector<Mat3> found;
    for (int cell = 0; cell < n_cells; ++cell) {
        const auto x = model.cell_nodes(std::span<const Vec3>(x_um), cell);
        Mat3 turned = Mat3::Zero(), straight = Mat3::Zero();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3& unit = model.topology->unit_shape[i];
            turned += (x[i] - centres[0]) / 9.0 * unit.transpose();
            straight += unit * unit.transpose();
        }
        found.push_back(turned * straight.inverse());
    }
    return found;
}

TEST(PlacedCells, AreTurnedEachByItsOwnRotationOfTheSeed) {
    const std::vector<Mat3> turned = rotations(20, 1);
    for (std::size_t a = 0; a < turned.size(); ++a) {
        EXPECT_LT((turned[a] * turned[a].transpose() - Mat3::Identity()).norm(), 1e-12);
        EXPECT_NEAR(turned[a].determinant(), 1.0, 1e-12) << "not mirrored";
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_GT((turned[a] - turned[b]).norm(), 0.05) << a << " and " << b << " are aligned";
    }
    EXPECT_EQ(rotations(20, 1)[7], turned[7]);
    EXPECT_GT((rotations(20, 2)[7] - turned[7]).norm(), 0.05);
}

TEST(PlacedCells, AreTurnedIntoAllDirectionsAlike) {
    // The mean of rotation matrices that prefer nothing is zero. Each element is of variance 1/3,
    // and its mean over n cells of 1/3n: 4.5 standard errors for nine of them.
    const int n_cells = 3000;
    Mat3 mean = Mat3::Zero();
    for (const Mat3& rotation : rotations(n_cells, 5)) mean += rotation / n_cells;
    EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4.5 / std::sqrt(3.0 * n_cells));
}

}  // namespace
}  // namespace spheroscope::test
