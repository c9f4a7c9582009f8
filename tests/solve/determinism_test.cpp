#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

class Determinism : public testing::TestWithParam<std::string_view> {
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
    std::uint64_t hash_after_run(System& system, int n_steps = 20) {
        MethodParameters parameters;
        parameters.dt_s = 2e-3;
        if (find_method(GetParam())->adaptive()) parameters.tolerance_um = 2e-3;
        const auto method = find_method(GetParam())->make(parameters);
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

TEST_P(Determinism, SameBitsOnOneTwoThreeAndSixteenThreads) {
    System alone(cells.model, make_parts(values()), 1);
    const std::uint64_t expected = hash_after_run(alone);
    EXPECT_EQ(alone.contacts().groups.size(), 6U) << "every cell touches every other one";
    for (const int n_threads : {2, 3, 16}) {
        System system(cells.model, make_parts(values()), n_threads);
        EXPECT_EQ(hash_after_run(system), expected) << n_threads << " threads";
        // Six pairs of cells are work for six members.
        EXPECT_EQ(members_with_work(system), std::min(n_threads, 6));
    }
}

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

TEST_P(Determinism, SameBitsWithTheVariationalLaw) {
    cells = make_doublet(42, 7, 5.0, 5.5, 0.3, 0.05);
    PartValues variational = values();
    variational.contact->form = ContactForm::variational;
    constexpr int n_steps = 5;
    System alone(cells.model, make_parts(variational), 1);
    const std::uint64_t expected = hash_after_run(alone, n_steps);
    for (const int n_threads : {2, 3}) {
        System system(cells.model, make_parts(variational), n_threads);
        EXPECT_EQ(hash_after_run(system, n_steps), expected) << n_threads << " threads";
        EXPECT_EQ(members_with_work(system), 2) << "two cells";
    }
    System traction(cells.model, make_parts(values()), 1);
    EXPECT_NE(hash_after_run(traction, n_steps), expected) << "another law";
}

INSTANTIATE_TEST_SUITE_P(Methods, Determinism, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods()) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope::test
