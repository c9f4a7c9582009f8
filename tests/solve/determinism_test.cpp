#include "engine/contact/simd_target.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace spheroscope::test {
namespace {

/// Four cells, each of which touches all others, and what is left of them after some steps.
class ShortRuns {
  protected:
    static PartValues values() {
        PartValues v = case_a_values();
        v.T_I_s = 0.115;
        v.T_d_s = 1.15;
        v.contact_friction = ContactFriction{0.07, 0.02};
        return v;
    }
    Cluster cells = make_cluster(42, 21, 0.3, 0.05);

    /// The state's hash after some steps; the system is left for a look at its workers.
    std::uint64_t hash_after_steps(std::string_view name, System& system, int n_steps) {
        MethodParameters parameters;
        parameters.dt_s = 2e-3;
        if (find_method(name)->adaptive()) parameters.tolerance_um = 2e-3;
        const auto method = find_method(name)->make(parameters);
        State state = state_at(cells.model, cells.x_um);
        for (int step = 0; step < n_steps; ++step)
            EXPECT_TRUE(method->advance(system, state, 1e9, false).accepted);
        return state.hash();
    }
    static std::ptrdiff_t members_with_work(System& system) {
        const std::vector<std::int64_t> done = system.workers().items_done();
        return std::count_if(done.begin(), done.end(), [](std::int64_t n) { return n > 0; });
    }
};

/// Every method, both laws of contact, every instruction set of the contact kernel.
class DeterminismOfEveryKernel
    : public ShortRuns,
      public testing::TestWithParam<std::tuple<std::string_view, ContactForm, std::string>> {
  protected:
    void SetUp() override { ASSERT_TRUE(use_simd_target(std::get<2>(GetParam()))); }
    void TearDown() override { ASSERT_TRUE(use_simd_target(simd_targets().front())); }
};

TEST_P(DeterminismOfEveryKernel, SameBitsOnOneTwoThreeAndSixteenThreads) {
    const auto [method, form, target] = GetParam();
    PartValues parts = values();
    parts.contact->form = form;
    constexpr int n_steps = 5;
    System alone(cells.model, make_parts(parts), 1);
    const std::uint64_t expected = hash_after_steps(method, alone, n_steps);
    EXPECT_EQ(alone.contacts().groups.size(), 6U) << "every cell touches every other one";
    for (const int n_threads : {2, 3, 16}) {
        System system(cells.model, make_parts(parts), n_threads);
        EXPECT_EQ(hash_after_steps(method, system, n_steps), expected) << n_threads << " threads";
        // Six pairs of cells are work for six members.
        EXPECT_EQ(members_with_work(system), std::min(n_threads, 6));
    }
    parts.contact->form =
        form == ContactForm::traction ? ContactForm::variational : ContactForm::traction;
    System other(cells.model, make_parts(parts), 1);
    EXPECT_NE(hash_after_steps(method, other, n_steps), expected) << "another law";
}

std::vector<std::string_view> names_of_methods() {
    std::vector<std::string_view> names;
    for (const MethodRow& row : all_methods()) names.push_back(row.name);
    return names;
}

using Kernel = std::tuple<std::string_view, ContactForm, std::string>;

std::string name_of(const testing::TestParamInfo<Kernel>& tested) {
    const auto& [method, form, target] = tested.param;
    return std::string(method) + (form == ContactForm::traction ? "_traction_" : "_variational_") +
           target;
}

INSTANTIATE_TEST_SUITE_P(Methods, DeterminismOfEveryKernel,
                         testing::Combine(testing::ValuesIn(names_of_methods()),
                                          testing::Values(ContactForm::traction,
                                                          ContactForm::variational),
                                          testing::ValuesIn(simd_targets())),
                         name_of);

class Determinism : public ShortRuns, public testing::TestWithParam<std::string_view> {
  protected:
    std::uint64_t hash_after_run(System& system, int n_steps = 20) {
        return hash_after_steps(GetParam(), system, n_steps);
    }
};

TEST_P(Determinism, SameBitsWithSixteenThreadsThatAllHaveWork) {
    cells.model = make_model(make_icosphere(42), std::vector<double>(16, 5.0));
    std::vector<Vec3> centres;
    for (int i = 0; i < 16; ++i)
        centres.emplace_back(9.8 * (i % 4), 9.8 * (i / 4 % 2), 9.8 * (i / 8));
    cells.x_um = turned_cells(cells.model, centres, 5, 0.05);
    System alone(cells.model, make_parts(values()), 1),
        system(cells.model, make_parts(values()), 16);
    EXPECT_EQ(hash_after_run(system, 5), hash_after_run(alone, 5));
    EXPECT_EQ(members_with_work(system), 16);
    EXPECT_GE(alone.contacts().groups.size(), 28U);
}

TEST_P(Determinism, SameBitsInASecondRunOfTheSameSystem) {
    System system(cells.model, make_parts(values()), 2);
    const std::uint64_t first = hash_after_run(system);
    EXPECT_EQ(hash_after_run(system), first)
        << "lists and factors that are there already change nothing";
}

TEST_P(Determinism, ADifferenceInTheLastBitOfOneCoordinateChangesTheHash) {
    System system(cells.model, make_parts(values()), 1);
    const std::uint64_t first = hash_after_run(system);
    cells.x_um[100].z() = std::nextafter(cells.x_um[100].z(), 1e9);
    EXPECT_NE(hash_after_run(system), first);
}

INSTANTIATE_TEST_SUITE_P(Methods, Determinism, testing::ValuesIn(names_of_methods()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope::test
