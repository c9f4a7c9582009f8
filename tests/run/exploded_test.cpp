// Frames pulled apart, and the principal axes of cells' stress.
#include "engine/run/exploded.hpp"
#include "engine/run/principal_stress.hpp"
#include "engine/scene/scene.hpp"

#include <gtest/gtest.h>

namespace spheroscope {
namespace {

/// Two cells of two nodes, the one three times as large as the other.
Snapshot two_cells() {
    Snapshot snapshot;
    auto header = std::make_shared<RunHeader>();
    header->n_cells = 2;
    for (const std::string_view name : scene::k_stress_components)
        header->fields.push_back(find_field(name));
    snapshot.header = header;
    snapshot.centre_um = {0, 0, 0, 8, 0, 0};
    snapshot.x_um = {0, 1, 0, 0, -1, 0, 8, 2, 0, 8, -2, 0};
    snapshot.volume_um3 = {3, 1};
    return snapshot;
}

TEST(Exploded, MovesWholeCellsAwayFromTheMiddle) {
    const Snapshot before = two_cells(), after = exploded(before, 0.5);
    // The middle is at x = 2.
    EXPECT_EQ(after.centre_um, (std::vector<float>{-1, 0, 0, 11, 0, 0}));
    EXPECT_EQ(after.x_um, (std::vector<float>{-1, 1, 0, -1, -1, 0, 11, 2, 0, 11, -2, 0}));
    EXPECT_EQ(shift_when_exploded_um(before, 0.5, 1), Vec3(3, 0, 0));
    EXPECT_EQ(exploded(before, 0.0).x_um, before.x_um);
}

TEST(PrincipalStress, IsThatOfTheStoredComponents) {
    Snapshot snapshot = two_cells();
    const auto components = find_stress_components(*snapshot.header);
    ASSERT_TRUE(components);
    // Of the second cell: 3 along (1, 1, 0), -1 along (1, -1, 0), 2 along z.
    for (const float value : {1.0F, 1.0F, 2.0F, 2.0F, 0.0F, 0.0F})
        snapshot.fields.push_back({0.0F, value});
    const PrincipalStress stress = principal_stress(snapshot, *components, 1);
    EXPECT_LE((stress.value_kPa - Vec3(-1, 2, 3)).norm(), 1e-12);
    EXPECT_NEAR(std::abs(stress.axes.col(0).dot(Vec3(1, -1, 0).normalized())), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(stress.axes.col(2).dot(Vec3(1, 1, 0).normalized())), 1.0, 1e-12);
}

TEST(PrincipalStress, IsNotThereWithoutAllComponents) {
    auto header = std::make_shared<RunHeader>();
    for (const std::string_view name : scene::k_stress_components) {
        EXPECT_FALSE(find_stress_components(*header));
        ASSERT_NE(find_field(name), nullptr) << name;
        header->fields.push_back(find_field(name));
    }
    EXPECT_TRUE(find_stress_components(*header));
}

}  // namespace
}  // namespace spheroscope
