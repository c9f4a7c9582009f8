#include "tests/viewer/two_cells.hpp"
#include "viewer/model/pick.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::viewer {
namespace {

Sight along_x(double y_um, double z_um, double direction = 1.0) {
    return {Vec3(0.0, y_um, z_um), Vec3(direction, 0.0, 0.0), false, Vec3::Zero()};
}

/// The value of a row under a heading that begins with `of`.
std::string value_in(const std::vector<TableRow>& rows, const std::string& of,
                     const std::string& what) {
    bool inside = false;
    for (const TableRow& row : rows) {
        if (row.value.empty()) inside = row.what.rfind(of, 0) == 0;
        if (inside && row.what == what) return row.value + " " + row.unit;
    }
    return "";
}

TEST(Picking, FindsTheFirstSurfaceOnTheLineOfSight) {
    const auto snapshot = two_cells();
    const auto from_left = pick(*snapshot, along_x(2.0, 1.0));
    ASSERT_TRUE(from_left.has_value());
    EXPECT_EQ(from_left->cell, 0);
    EXPECT_LT(from_left->point_um.x(), -14.0);
    EXPECT_EQ(from_left->other_cell, -1);  // nobody touches the outer side
    const auto from_right = pick(*snapshot, along_x(2.0, 1.0, -1.0));
    ASSERT_TRUE(from_right.has_value());
    EXPECT_EQ(from_right->cell, 1);
}

TEST(Picking, MissesBesideTheCells) {
    EXPECT_FALSE(pick(*two_cells(), along_x(9.0, 0.0)).has_value());
}

TEST(Picking, TheNodeIsTheNearestCornerOfTheTriangle) {
    const auto snapshot = two_cells();
    const auto found = pick(*snapshot, along_x(1.3, -2.1));
    ASSERT_TRUE(found.has_value());
    const MeshTopology& mesh = *snapshot->header->topology;
    const auto& corners = mesh.triangles[static_cast<std::size_t>(found->triangle)];
    EXPECT_NE(std::find(corners.begin(), corners.end(), found->node), corners.end());
    const auto distance = [&](int node) {
        const auto i = static_cast<std::size_t>(found->cell * mesh.n_nodes() + node);
        return (Vec3(double{snapshot->x_um[3 * i]}, double{snapshot->x_um[3 * i + 1]},
                     double{snapshot->x_um[3 * i + 2]}) -
                found->point_um)
            .norm();
    };
    for (const int corner : corners) EXPECT_LE(distance(found->node), distance(corner));
}

TEST(Picking, PassesThroughCellsThatTheCutawayLeavesOut) {
    const auto snapshot = two_cells();
    Sight sight = along_x(0.5, 0.5);
    sight.cutaway = true;  // the eye is at x < 0, cell 0 on its side of the middle
    const auto found = pick(*snapshot, sight);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->cell, 1);
    EXPECT_EQ(found->other_cell, 0);  // this is where they touch
}

TEST(Picking, FindsTheNeighbourAsFarAsTheScenesContactsReach) {
    for (const auto& [h0_um, neighbour] : {std::pair{0.3, -1}, std::pair{1.0, 0}}) {
        const auto snapshot = two_cells(h0_um);
        for (std::size_t i = snapshot->x_um.size() / 2; i < snapshot->x_um.size(); i += 3)
            snapshot->x_um[i] += 1.4F;
        snapshot->centre_um[3] += 1.4F;
        Sight sight = along_x(0.3, 0.3);
        sight.cutaway = true;
        const auto found = pick(*snapshot, sight);
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(found->cell, 1);
        EXPECT_EQ(found->other_cell, neighbour) << h0_um;
    }
}

TEST(Picking, TheTableHasValuesInTheUnitsOfLegends) {
    const auto snapshot = two_cells();
    const std::vector<TableRow> rows = describe(*snapshot, {0, 5, 3, 1, Vec3::Zero()});
    EXPECT_EQ(value_in(rows, "node 3", "γ^eff"), "3 mN/m");
    EXPECT_EQ(value_in(rows, "triangle 5", "σ^c_nn"), "100 Pa");
    EXPECT_EQ(value_in(rows, "cell 0", "σ^h"), "-20 Pa");
    EXPECT_EQ(value_in(rows, "cell 0", "pressure"), "125 Pa");
    EXPECT_EQ(value_in(rows, "contact 0-1", "force (pushes apart)"), "2 nN");
    EXPECT_EQ(value_in(rows, "contact 0-1", "force / area"), "200 Pa");
    // what is not there has a word, and no number
    EXPECT_EQ(value_in(describe(*snapshot, {0, 6, 3, -1, Vec3::Zero()}), "triangle", "σ^c_nn"),
              "no contact ");
}

TEST(Picking, SeedsHaveNoMechanics) {
    const auto snapshot = two_cells();
    snapshot->stage_name = "anneal";
    for (const TableRow& row : describe(*snapshot, {0, 5, 3, 1, Vec3::Zero()}))
        EXPECT_TRUE(row.unit != "Pa" && row.unit != "nN" && row.unit != "mN/m") << row.what;
}

TEST(Picking, TheTableBecomesCsv) {
    const auto snapshot = two_cells();
    const std::string csv = csv_text(*snapshot, describe(*snapshot, {0, 5, 3, 1, Vec3::Zero()}));
    EXPECT_EQ(csv.rfind("# two.toml, frame 7, t = 1.5 s\nof,quantity,value,unit\n", 0), 0U);
    EXPECT_NE(csv.find("\ntriangle 5,σ^c_nn,100,Pa\n"), std::string::npos);
    EXPECT_NE(csv.find("\ncell 0,x,-8.0000,µm\n"), std::string::npos);
    const std::string quoted = csv_text(*snapshot, {{"a, b", "", ""}, {"so \"called\"", "1", ""}});
    EXPECT_NE(quoted.find("\n\"a, b\",\"so \"\"called\"\"\",1,\n"), std::string::npos) << quoted;
    EXPECT_NE(csv_text(*snapshot, {{"a\rb", "1", ""}}).find("\"a\rb\""), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::viewer
