// The contact law `variational` on stored shapes: what the engine says about it against an
// independent program that differentiates the energy numerically (tests/reference/python).
#include "engine/contact/surface_samples.hpp"
#include "engine/forces/contact_pairs.hpp"
#include "tests/reference_twin/twin_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace spheroscope::test {
namespace {

/// Both programs compute in doubles, and complex steps are exact to rounding.
constexpr double k_double = 1e-12;
/// What a coefficient of the law is changed by, to see that the comparison notices.
constexpr double k_perturbation = 1e-9;

/// How far the engine is from the twin on one configuration, each over the twin's largest.
struct Difference {
    double force = 0.0;   ///< largest |a - b| at a node over the largest |b|, of the contact force
    double energy = 0.0;  ///< of the contact
};

class TwinVariational : public testing::TestWithParam<const char*> {
  protected:
    [[nodiscard]] int n_configurations() const {
        return static_cast<int>(twin.attribute("", "n_configurations"));
    }
    [[nodiscard]] static std::string configuration(int n) {
        return "configuration_" + std::to_string(n);
    }
    /// The engine at a stored configuration, with this law.
    [[nodiscard]] std::unique_ptr<System> engine(int n, const ContactLaw& law) const {
        PartValues values;
        values.contact = law;
        auto system = std::make_unique<System>(twin.model(), make_parts(values), 1,
                                               Need::triangles | Need::volumes);
        const std::vector<double> no_integral(twin.model().radius_um.size(), 0.0);
        EXPECT_FALSE(system->evaluate(twin.vectors(configuration(n) + "/x"), no_integral, 0.0));
        return system;
    }
    [[nodiscard]] Difference difference(int n, const ContactLaw& law) const {
        const auto system = engine(n, law);
        const double energy_fJ = twin.attribute(configuration(n), "contact_energy_fJ");
        EXPECT_LT(energy_fJ, 0.0);
        return {relative_difference(system->force_nN(),
                                    twin.vectors(configuration(n) + "/force/contact")),
                std::abs(system->energy_fJ() / energy_fJ - 1.0)};
    }

    TwinProblem twin{GetParam(), ContactForm::variational};
    ContactLaw own_law = *twin.values().contact;
};

TEST_P(TwinVariational, HasTheEnginesLaw) {
    EXPECT_NEAR(own_law.P0_kPa / twin.attribute("", "P0_kPa"), 1.0, k_double);
    EXPECT_NEAR(own_law.k_kPa_per_um / twin.attribute("", "k_kPa_per_um"), 1.0, k_double);
    EXPECT_EQ(samples_per_edge(twin.model(), own_law.h0_um), twin.attribute("", "parts_per_edge"));
}

TEST_P(TwinVariational, HasTheEnginesForcesAndEnergyOfContact) {
    for (int n = 0; n < n_configurations(); ++n) {
        SCOPED_TRACE(configuration(n));
        const Difference found = difference(n, own_law);
        EXPECT_LE(found.force, k_double);
        EXPECT_LE(found.energy, k_double);
    }
}

TEST_P(TwinVariational, HasTheEnginesVolumesStressesAndAreasOfContact) {
    for (int n = 0; n < n_configurations(); ++n) {
        SCOPED_TRACE(configuration(n));
        expect_same_measures(measures_of(*engine(n, own_law)), twin.measures(configuration(n)),
                             k_double);
    }
}

TEST_P(TwinVariational, NoticesACoefficientThatIsOffByABillionth) {
    for (double ContactLaw::*coefficient :
         {&ContactLaw::h0_um, &ContactLaw::P0_kPa, &ContactLaw::k_kPa_per_um})
        for (int n = 0; n < n_configurations(); ++n) {
            ContactLaw other = own_law;
            other.*coefficient *= 1.0 + k_perturbation;
            EXPECT_GT(difference(n, other).force, 10.0 * k_double) << configuration(n);
        }
}

TEST_P(TwinVariational, NoticesAMissingTensionOfTheSurface) {
    // Pairs alone, without the part of the force that comes from the area's derivative.
    for (int n = 0; n < n_configurations(); ++n) {
        const auto system = engine(n, own_law);
        std::vector<Vec3> force(twin.model().n_all_nodes(), Vec3::Zero());
        for (int cell = 0; cell < twin.model().n_cells(); ++cell)
            add_pair_forces(system->configuration(), cell,
                            twin.model().cell_nodes(std::span<Vec3>(force), cell));
        EXPECT_GT(relative_difference(force, twin.vectors(configuration(n) + "/force/contact")),
                  1e-3)
            << configuration(n);
    }
}

INSTANTIATE_TEST_SUITE_P(Problems, TwinVariational,
                         testing::Values("doublet", "fine_doublet", "thirteen"),
                         [](const auto& problem) { return std::string(problem.param); });

}  // namespace
}  // namespace spheroscope::test
