#include "engine/solve/conjugate_gradients.hpp"

#include <cmath>
#include <numeric>

namespace spheroscope {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

double total(const std::vector<double>& per_cell) {
    return std::accumulate(per_cell.begin(), per_cell.end(), 0.0);
}

}  // namespace

SolveOutcome ConjugateGradients::solve(const VelocitySystem& system,
                                       const Preconditioner& preconditioner,
                                       std::span<const Vec3> b, std::span<Vec3> x, double tolerance,
                                       int largest_iterations, Workers& workers) {
    const Model& model = system.model;
    for (std::vector<Vec3>* v : {&residual_, &direction_, &product_, &preconditioned_})
        v->resize(b.size());
    for (std::vector<double>* s : {&sum_bb_, &sum_rr_, &sum_rz_, &sum_pq_})
        s->assign(model.radius_um.size(), 0.0);
    const auto of_cell = [&](std::vector<Vec3>& v, int cell) {
        return model.cell_nodes(std::span<Vec3>(v), cell);
    };

    SolveOutcome outcome;  // written by member 0
    workers.region([&](Workers::Member& member) {
        const auto cells = member.share(model.n_cells());
        const auto groups = member.share(system.n_groups());
        const auto multiply_groups = [&](std::span<const Vec3> u) {
            for (int g = groups.begin; g < groups.end; ++g) system.product_of_group(g, u);
            member.wait();
        };
        const auto precondition = [&](int cell) {
            const std::span<Vec3> r = of_cell(residual_, cell);
            const std::span<Vec3> z = of_cell(preconditioned_, cell);
            preconditioner.apply(cell, r, z);
            sum_rz_[idx(cell)] = dot(r, z);
            sum_rr_[idx(cell)] = dot(r, r);
        };

        multiply_groups(x);
        for (int cell = cells.begin; cell < cells.end; ++cell) {
            const std::span<Vec3> q = of_cell(product_, cell);
            const std::span<Vec3> r = of_cell(residual_, cell);
            const std::span<const Vec3> b_cell = model.cell_nodes(b, cell);
            system.product_of_cell(cell, x, q);
            for (std::size_t i = 0; i < r.size(); ++i) r[i] = b_cell[i] - q[i];
            sum_bb_[idx(cell)] = dot(b_cell, b_cell);
            precondition(cell);
        }
        member.wait();
        const double bb = total(sum_bb_);
        double rr = total(sum_rr_);
        double rz = total(sum_rz_);
        double beta = 0.0;
        int iteration = 0;
        const double enough = tolerance * tolerance * bb;
        // A residual that is not a number fails both tests and leaves as 'not converged'.
        while (rr > enough && iteration < largest_iterations) {
            ++iteration;
            for (int cell = cells.begin; cell < cells.end; ++cell) {
                const std::span<Vec3> p = of_cell(direction_, cell);
                const std::span<const Vec3> z = of_cell(preconditioned_, cell);
                if (beta == 0.0)
                    std::copy(z.begin(), z.end(), p.begin());
                else
                    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + beta * p[i];
            }
            member.wait();
            multiply_groups(direction_);
            for (int cell = cells.begin; cell < cells.end; ++cell) {
                const std::span<Vec3> q = of_cell(product_, cell);
                system.product_of_cell(cell, direction_, q);
                sum_pq_[idx(cell)] = dot(of_cell(direction_, cell), q);
            }
            member.wait();
            const double alpha = rz / total(sum_pq_);
            for (int cell = cells.begin; cell < cells.end; ++cell) {
                const std::span<const Vec3> p = of_cell(direction_, cell);
                const std::span<const Vec3> q = of_cell(product_, cell);
                const std::span<Vec3> r = of_cell(residual_, cell);
                const std::span<Vec3> x_cell = model.cell_nodes(x, cell);
                for (std::size_t i = 0; i < r.size(); ++i) {
                    x_cell[i] += alpha * p[i];
                    r[i] -= alpha * q[i];
                }
                precondition(cell);
            }
            member.wait();
            rr = total(sum_rr_);
            const double next_rz = total(sum_rz_);
            beta = next_rz / rz;
            rz = next_rz;
        }
        if (member.index() == 0) {
            outcome.converged = rr <= enough;
            outcome.iterations = iteration;
            outcome.relative_residual = bb > 0.0 ? std::sqrt(rr / bb) : 0.0;
        }
    });
    return outcome;
}

}  // namespace spheroscope
