// Whether the linear system of an implicit step would be solved faster by factoring it, where the
// cells are few enough for that: one cell and two, in steps of milliseconds to seconds. Both find
// the same velocities; the times are printed, and stand in engine/README.md, 'Linear solves'.
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <cholmod.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

namespace spheroscope::test {
namespace {

/// The matrix behind the products in CHOLMOD's form, analysed once: its pattern is taken as fixed,
/// as that of a single cell is.
class Factorisation {
  public:
    explicit Factorisation(const VelocitySystem& system, Workers& workers) {
        cholmod_start(&common_);
        common_.print = 0;
        const std::size_t n = 3 * system.x_um.size();
        std::vector<int> rows, columns;
        std::vector<double> values;
        std::vector<Vec3> unit(system.x_um.size(), Vec3::Zero()), product(unit.size());
        for (std::size_t column = 0; column < n; ++column) {
            unit[column / 3][static_cast<int>(column % 3)] = 1.0;
            system.product(unit, product, workers);
            unit[column / 3].setZero();
            for (std::size_t row = column; row < n; ++row) {
                const double value = product[row / 3][static_cast<int>(row % 3)];
                if (value == 0.0) continue;
                rows.push_back(static_cast<int>(row));
                columns.push_back(static_cast<int>(column));
                values.push_back(value);
            }
        }
        cholmod_triplet* triplet =
            cholmod_allocate_triplet(n, n, values.size(), -1, CHOLMOD_REAL, &common_);
        std::copy(rows.begin(), rows.end(), static_cast<int*>(triplet->i));
        std::copy(columns.begin(), columns.end(), static_cast<int*>(triplet->j));
        std::copy(values.begin(), values.end(), static_cast<double*>(triplet->x));
        triplet->nnz = values.size();
        matrix_ = cholmod_triplet_to_sparse(triplet, values.size(), &common_);
        cholmod_free_triplet(&triplet, &common_);
        factor_ = cholmod_analyze(matrix_, &common_);
    }
    ~Factorisation() {
        cholmod_free_factor(&factor_, &common_);
        cholmod_free_sparse(&matrix_, &common_);
        cholmod_finish(&common_);
    }
    Factorisation(const Factorisation&) = delete;
    Factorisation& operator=(const Factorisation&) = delete;

    [[nodiscard]] std::vector<Vec3> solve(std::span<const Vec3> b) {
        cholmod_factorize(matrix_, factor_, &common_);
        cholmod_dense* right =
            cholmod_allocate_dense(3 * b.size(), 1, 3 * b.size(), CHOLMOD_REAL, &common_);
        std::copy_n(b.front().data(), 3 * b.size(), static_cast<double*>(right->x));
        cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor_, right, &common_);
        std::vector<Vec3> v(b.size());
        std::copy_n(static_cast<const double*>(solution->x), 3 * b.size(), v.front().data());
        cholmod_free_dense(&solution, &common_);
        cholmod_free_dense(&right, &common_);
        return v;
    }

  private:
    cholmod_common common_{};
    cholmod_sparse* matrix_ = nullptr;
    cholmod_factor* factor_ = nullptr;
};

/// The shortest of five, ms.
template <class Work> double shortest_ms(const Work& work) {
    double best_ms = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < 5; ++repetition) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begin;
        best_ms = std::min(best_ms, took.count());
    }
    return best_ms;
}

/// With its nodes pushed about, so that there is something to solve for.
Cluster lone_cell(int n_nodes) {
    Model model = model_with_nodes_on_sphere(n_nodes, 9.0);
    const std::vector<Vec3> centre{Vec3::Zero()};
    std::vector<Vec3> x_um = turned_cells(model, centre, 3, 0.05);
    return {std::move(model), std::move(x_um)};
}

void compare(const char* name, Cluster cells, double E_kPa) {
    PartValues values = case_a_values();
    values.E_kPa = E_kPa;
    values.T_I_s = 0.115;
    if (cells.model.n_cells() > 1)
        values.contact_friction = ContactFriction{0.05, 0.05};
    else
        values.contact = {};
    System system(cells.model, make_parts(values), 1);
    State state = state_at(cells.model, std::move(cells.x_um));
    MethodParameters parameters;
    parameters.dt_s = 1e-3;
    parameters.tolerance_um = 6e-3;
    const auto method = find_method("linearly_implicit")->make(parameters);
    ASSERT_TRUE(advance_until(*method, system, state, 0.5).accepted);
    ASSERT_FALSE(system.evaluate(state.x_um, state.volume_integral_s, 0.0));
    const std::vector<Vec3> b(system.force_nN().begin(), system.force_nN().end());
    for (const double dt_s : {0.01, 0.1, 1.0}) {
        // The volume's rank-one part is left out: both treat it in the same way, exactly.
        const VelocitySystem matrix = system.velocity_system(dt_s, {});
        Factorisation direct(matrix, system.workers());
        std::vector<Vec3> exact;
        const double direct_ms = shortest_ms([&] { exact = direct.solve(b); });
        std::printf("%-9s %5d nodes  E = %-7g dt = %4g s  factored %7.2f ms", name,
                    cells.model.n_nodes(), E_kPa, dt_s, direct_ms);
        BlockJacobi preconditioner;
        ConjugateGradients iterative;
        for (const double tolerance : {2e-3, 1e-6}) {
            std::vector<Vec3> v(b.size());
            SolveOutcome outcome;
            const double iterative_ms = shortest_ms([&] {
                std::fill(v.begin(), v.end(), Vec3::Zero());
                preconditioner.prepare(matrix, system.workers());
                outcome = iterative.solve(matrix, preconditioner, b, v, tolerance, 5000,
                                          system.workers());
            });
            EXPECT_TRUE(outcome.converged);
            // a sixteenth to a hundredth of the time when this was written
            EXPECT_LT(iterative_ms, direct_ms);
            std::printf("  to %g: %3d iterations %7.2f ms", tolerance, outcome.iterations,
                        iterative_ms);
            if (tolerance > 1e-5) continue;
            const Eigen::VectorXd expected = reference::flat(exact);
            EXPECT_LE((reference::flat(v) - expected).norm(), 1e-2 * expected.norm());
        }
        std::printf("\n");
    }
}

TEST(DirectSolve, AndIterationsFindTheSameVelocitiesOfOneCell) {
    for (const int n_nodes : {162, 642, 2562}) compare("one cell", lone_cell(n_nodes), 320.0);
}

TEST(DirectSolve, AndIterationsFindTheSameVelocitiesOfADoublet) {
    for (const int n_nodes : {162, 642})
        for (const double E_kPa : {0.3125, 20.0})
            compare("doublet", make_doublet(n_nodes, 7, 9.0, 9.0, 0.2), E_kPa);
}

}  // namespace
}  // namespace spheroscope::test
