#include "tests/viewer/two_cells.hpp"
#include "viewer/model/blame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace spheroscope::viewer {
namespace {

/// Two corners of a triangle fall together.
void collapse(Snapshot& snapshot, int cell, int triangle) {
    const MeshTopology& mesh = *snapshot.header->topology;
    const MeshTopology::Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto at = [&](int node) {
        return snapshot.x_um.begin() + 3 * (cell * mesh.n_nodes() + node);
    };
    std::copy_n(at(t[1]), 3, at(t[0]));
}

TEST(Blame, OfAVolumeGoesToTheCellAndItsContact) {
    const auto snapshot = two_cells();
    snapshot->volume_um3[1] *= 1.1F;
    const auto worst = blamed(row_of(Series::volume_error), *snapshot);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->cell, 1);
    EXPECT_EQ(worst->other_cell, 0);
    EXPECT_LT(worst->point_um.norm(),
              2.0);  // near the origin, where they touch: a triangle's middle
}

TEST(Blame, OfATriangleGoesToTheTriangle) {
    const auto snapshot = two_cells();
    collapse(*snapshot, 0, 9);
    const auto worst = blamed(row_of(Series::smallest_triangle), *snapshot);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->cell, 0);
    const MeshTopology& mesh = *snapshot->header->topology;
    const auto& t = mesh.triangles[9];
    EXPECT_NE(std::find(t.begin(), t.end(), worst->node), t.end());
    EXPECT_EQ(triangle_area_um2(*snapshot, 0, worst->triangle), 0.0);
    EXPECT_EQ(worst->other_cell, 1);  // it lies in no contact: the one that its cell has
}

TEST(Blame, OfTheForceBalanceGoesToTheContactOfTheLargestForce) {
    const auto snapshot = two_cells();
    const auto worst = blamed(row_of(Series::force_balance), *snapshot);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->cell + worst->other_cell, 1);
    snapshot->links.clear();
    EXPECT_FALSE(blamed(row_of(Series::force_balance), *snapshot));
    const auto alone = blamed(row_of(Series::volume_error), *snapshot);  // a cell without contacts
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->other_cell, -1);
}

}  // namespace
}  // namespace spheroscope::viewer
