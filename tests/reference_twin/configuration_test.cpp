// One configuration of cells that are stretched, sheared, rough and pressed together: what the
// engine says about it against an independent program (tests/reference/python).
#include "tests/reference_twin/twin_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

/// Both programs compute in doubles; what remains is rounding, and how well a clip polygon is
/// conditioned.
constexpr double k_double = 1e-12;
/// The contact kernel in floats: they hold positions inside a cell of 10 um to 6e-7 um, which is
/// 2e-6 of the range of the adhesion; several pairs add up at a node.
constexpr double k_single = 1e-5;
/// The elements of the contact friction are stored in single precision.
constexpr double k_stored_in_single = 2e-7;

class TwinConfiguration : public testing::TestWithParam<const char*> {
  protected:
    /// The engine at the stored configuration.
    [[nodiscard]] std::unique_ptr<System> engine(ContactPrecision precision,
                                                 const PartValues& values) const {
        SystemParts parts = make_parts(values);
        parts.contact_precision = precision;
        auto system = std::make_unique<System>(twin.model(), std::move(parts), 1,
                                               Need::triangles | Need::volumes);
        EXPECT_FALSE(system->evaluate(twin.vectors("configuration/x"),
                                      twin.numbers("configuration/volume_integral"), 0.0));
        return system;
    }
    [[nodiscard]] std::unique_ptr<System> engine(ContactPrecision precision) const {
        return engine(precision, twin.values());
    }

    TwinProblem twin{GetParam()};
};

TEST_P(TwinConfiguration, HasTheEnginesMesh) {
    // Rest shapes of the two programs may be turned and numbered differently.
    const Model own = make_model(make_icosphere(twin.model().n_nodes()), {1.0});
    const auto expect_same = [](std::vector<double> a, std::vector<double> b) {
        ASSERT_EQ(a.size(), b.size());
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
    };
    expect_same(own.unit_edge_length, twin.model().unit_edge_length);
    expect_same(own.unit_triangle_area, twin.model().unit_triangle_area);
    expect_same(own.unit_node_area, twin.model().unit_node_area);
    expect_same(own.rest_hinge_angle_rad, twin.model().rest_hinge_angle_rad);
}

TEST_P(TwinConfiguration, HasTheEnginesForcesTermByTerm) {
    const auto system = engine(ContactPrecision::double_precision);
    const std::vector<std::pair<std::string, std::string>> names{{"cortex.elastic", "elastic"},
                                                                 {"cortex.bending", "bending"},
                                                                 {"cortex.tension", "tension"},
                                                                 {"cytosol", "cytosol"},
                                                                 {"contact", "contact"}};
    ASSERT_EQ(system->parts().terms.size(), names.size());
    for (std::size_t n = 0; n < names.size(); ++n) {
        const ForceTerm& term = *system->parts().terms[n];
        ASSERT_EQ(term.name(), names[n].first);
        EXPECT_LE(relative_difference(system->force_of_term(term),
                                      twin.vectors("configuration/force/" + names[n].second)),
                  k_double)
            << term.name();
    }
    EXPECT_LE(relative_difference(system->force_nN(), twin.vectors("configuration/force/total")),
              k_double);
}

TEST_P(TwinConfiguration, HasTheEnginesForcesInFloatsToTheirBound) {
    const auto system = engine(ContactPrecision::single_precision);
    const double difference =
        relative_difference(system->force_nN(), twin.vectors("configuration/force/total"));
    EXPECT_LE(difference, k_single);
    EXPECT_GT(difference, k_double) << "these were no floats";
}

TEST_P(TwinConfiguration, HasTheEnginesVolumesStressesAndAreasOfContact) {
    const auto system = engine(ContactPrecision::double_precision);
    expect_same_measures(measures_of(*system), twin.measures("configuration"), k_double);
}

TEST_P(TwinConfiguration, HasTheEnginesFrictionMatrix) {
    const auto system = engine(ContactPrecision::double_precision);
    const std::vector<Vec3> u = twin.vectors("configuration/friction/u");
    std::vector<Vec3> product(u.size());
    system->friction_product(u, product);
    EXPECT_LE(relative_difference(product, twin.vectors("configuration/friction/total")),
              k_stored_in_single);
}

TEST_P(TwinConfiguration, HasTheEnginesContactFrictionAlongAndAcrossTheNormal) {
    const std::string path = "configuration/friction/contact_unequal";
    PartValues values = twin.values();
    values.contact_friction = ContactFriction{twin.attribute(path, "normal_kPa_s_per_um"),
                                              twin.attribute(path, "tangential_kPa_s_per_um")};
    values.T_d_s = 0.0;  // no friction of the volume
    const auto with = engine(ContactPrecision::double_precision, values);
    values.contact_friction.reset();
    const auto without = engine(ContactPrecision::double_precision, values);
    const std::vector<Vec3> u = twin.vectors("configuration/friction/u");
    std::vector<Vec3> contact(u.size()), rest(u.size());
    with->friction_product(u, contact);
    without->friction_product(u, rest);
    EXPECT_LE(relative_difference(rest, twin.vectors("configuration/friction/medium_and_cortex")),
              k_double);
    for (std::size_t i = 0; i < u.size(); ++i) contact[i] -= rest[i];
    EXPECT_LE(relative_difference(contact, twin.vectors(path)), k_stored_in_single);
}

TEST_P(TwinConfiguration, MovesWithTheEnginesVelocity) {
    const auto system = engine(ContactPrecision::double_precision);
    std::vector<Vec3> v(twin.model().n_all_nodes(), Vec3::Zero());
    ASSERT_TRUE(system->solve_friction(system->force_nN(), v, 1e-9).converged);
    // The friction's elements are stored in single precision.
    EXPECT_LE(relative_difference(v, twin.vectors("configuration/v")), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Problems, TwinConfiguration,
                         testing::Values("doublet", "thirteen", "fine_doublet"),
                         [](const auto& problem) { return std::string(problem.param); });

}  // namespace
}  // namespace spheroscope::test
