#include "engine/forces/active_tension.hpp"
#include "engine/forces/bending.hpp"
#include "engine/forces/body_force.hpp"
#include "engine/forces/compaction_wall.hpp"
#include "engine/forces/cytosol_pressure.hpp"
#include "engine/forces/fold_stop.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/forces/strain_limiter.hpp"
#include "tests/forces/test_cell.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace spheroscope::test {
namespace {

constexpr int k_cell = TestCell::cell;

TEST(Cytosol, PressureIsOffsetPlusExtraMinusVolumeStrainMinusItsIntegral) {
    const CytosolPressure cytosol({}, {.K_kPa = 5.0,
                                       .T_I_s = 0.8,
                                       .T_d_s = 0.1,
                                       .extra_pressure_kPa = 0.03,
                                       .gamma_nN_per_um = 0.5});
    TestCell test(162);  // V* is 1 % above the volume of the rest shape
    const double offset =
        2.0 * 0.5 / 3.0 * (81.0 * test.model.unit_area) / test.model.rest_volume_um3(k_cell);
    const double eps = 1.0 / 1.01 - 1.0;
    EXPECT_NEAR(cytosol.volume_strain(test.at(), k_cell), eps, 1e-13);
    EXPECT_NEAR(cytosol.offset_kPa(test.model, k_cell), offset, 1e-13);
    test.volume_integral_s[1] = 0.02;
    EXPECT_NEAR(cytosol.pressure_kPa(test.at(), k_cell),
                offset + 0.03 - 5.0 * eps - 5.0 / 0.8 * 0.02, 1e-12);
}

TEST(Cytosol, ProportionalControllerDoesNotReadTheIntegral) {
    const CytosolPressure cytosol({}, {.K_kPa = 5.0});
    TestCell test(42);
    const double before = cytosol.pressure_kPa(test.at(), k_cell);
    test.volume_integral_s[1] = 1e3;
    EXPECT_EQ(cytosol.pressure_kPa(test.at(), k_cell), before);
}

TEST(Cytosol, OffsetFallsWithTheRadiusAndVanishesWithoutTension) {
    const TestCell test(162);
    const CytosolPressure tense({}, {.K_kPa = 5.0, .gamma_nN_per_um = 0.5});
    const CytosolPressure slack({}, {.K_kPa = 5.0});
    EXPECT_NEAR(tense.offset_kPa(test.model, 0) / tense.offset_kPa(test.model, 1), 9.0 / 7.0,
                1e-13);
    EXPECT_EQ(slack.offset_kPa(test.model, 0), 0.0);
}

TEST(CompactionWall, PressesWithItsStiffnessTimesOverlapPerRestArea) {
    const double k = 50.0;
    const CompactionWall wall({}, CompactionWallParameters{k});
    TestCell test(162);
    const double sphere = test.x()[0].norm();
    const double overlap = 0.25;
    test.wall_radius_um = sphere - overlap;
    const double area = 81.0 * test.model.unit_area;
    double load = 0.0;
    const std::vector<Vec3> F = test.force_nN(wall);
    for (std::size_t i = 0; i < F.size(); ++i) {
        load -= F[i].dot(test.x()[i]) / sphere;
        EXPECT_LT(F[i].cross(test.x()[i]).norm(), 1e-12) << "frictionless: radial";
    }
    EXPECT_NEAR(load, k * area * overlap, 1e-10 * load);
    EXPECT_NEAR(wall.load_nN(test.at(), k_cell), load, 1e-10 * load);
    EXPECT_NEAR(test.energy_fJ(wall), 0.5 * k * area * overlap * overlap, 1e-10 * load);
}

TEST(CompactionWall, DoesNotActOnWhatIsInsideNorWhenNoWallStands) {
    const CompactionWall wall({}, CompactionWallParameters{50.0});
    TestCell test(162);
    for (const double radius : {1.0001 * test.x()[0].norm(), 0.0}) {
        test.wall_radius_um = radius;
        EXPECT_EQ(norm(test.force_nN(wall)), 0.0);
        EXPECT_EQ(test.energy_fJ(wall), 0.0);
    }
}

TEST(BodyForce, SumsToTheForceOnTheCellAndAnOpposedPairIsInBalance) {
    const Vec3 force(1.0, -2.0, 0.5);
    const TestCell test(162);
    for (const bool opposed : {false, true}) {
        const BodyForce body({}, BodyForceParameters{force, opposed});
        Vec3 both = Vec3::Zero();
        for (int cell = 0; cell < 2; ++cell) {
            std::vector<Vec3> F(test.n_nodes(), Vec3::Zero());
            body.add_force(test.at(), cell, F);
            for (const Vec3& f : F) both += f;
        }
        EXPECT_LT((both - (opposed ? 0.0 : 2.0) * force).norm(), 1e-12);
    }
}

std::string message_of(auto&& make) {
    try {
        make();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(ParametersOutOfRange, AreRefusedWithTheirPlaceAndValue) {
    const Loc loc{"a.toml", 3, 5};
    const std::string text =
        message_of([&] { InPlaneElasticity(loc, {.E_kPa = -2.0, .thickness_um = 0.2}); });
    EXPECT_NE(text.find("a.toml:3:5"), std::string::npos) << text;
    EXPECT_NE(text.find("cortex.elastic.E wants a value above 0, got -2 kPa"), std::string::npos)
        << text;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Bending(loc, {.E_kPa = 20.0, .thickness_um = 0.2, .poisson = 1.0}), Error);
    EXPECT_THROW(ActiveTension(loc, {-0.1}), Error);
    EXPECT_THROW(ActiveTension(loc, {nan}), Error);
    EXPECT_THROW(CytosolPressure(loc, {.K_kPa = 5.0, .T_I_s = 0.0}), Error);
    EXPECT_THROW(CompactionWall(loc, {0.0}), Error);
    EXPECT_THROW(BodyForce(loc, {Vec3(0, nan, 0), false}), Error);
    EXPECT_THROW(StrainLimiter(loc, {0.25, 0.0}), Error);
    EXPECT_THROW(FoldStop(loc, {0.25, 4.0}), Error);
}

}  // namespace
}  // namespace spheroscope::test
