#include "engine/solve/fastest_mode.hpp"

#include "engine/base/index.hpp"
#include "engine/base/random.hpp"
#include "engine/forces/cell_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

/// Of the friction solves: an estimate to some percent needs no more.
constexpr double k_solve_tolerance = 1e-2;
/// The iteration ends when the rate has grown by less than this in one of its steps, and not
/// before k_fewest of them.
constexpr double k_enough = 2e-3;
constexpr std::size_t k_fewest = 8;

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, by bisection on the signs of its leading
/// minors.
double largest_eigenvalue(std::span<const double> diagonal, std::span<const double> off_diagonal) {
    double low = *std::max_element(diagonal.begin(), diagonal.end());
    double high = low;
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        const double left = i > 0 ? std::abs(off_diagonal[i - 1]) : 0.0;
        const double right = i + 1 < diagonal.size() ? std::abs(off_diagonal[i]) : 0.0;
        high = std::max(high, diagonal[i] + left + right);  // Gershgorin
    }
    const auto is_above_all = [&](double x) {
        double pivot = x - diagonal[0];
        for (std::size_t i = 1; i < diagonal.size() && pivot > 0.0; ++i)
            pivot = x - diagonal[i] - off_diagonal[i - 1] * off_diagonal[i - 1] / pivot;
        return pivot > 0.0;
    };
    while (high - low > 1e-6 * high) {
        const double middle = 0.5 * (low + high);
        (is_above_all(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace

void FastestMode::multiply_stiffness(System& system) {
    system.velocity_system(1.0, volume_coefficient_).product(q_, z_, system.workers());
    for (std::size_t i = 0; i < z_.size(); ++i) z_[i] -= p_[i];
}

void FastestMode::iterate(System& system, std::span<const double> weights) {
    const Model& model = system.model();
    const std::size_t n = model.n_all_nodes();
    for (std::vector<Vec3>* v : {&q_, &p_, &p_before_, &r_, &z_, &mode_}) v->resize(n);
    diagonal_.clear();
    off_diagonal_.clear();
    volume_coefficient_.clear();
    if (const CytosolPressure* cytosol = system.parts().cytosol)
        for (const double target_um3 : model.target_volume_um3)
            volume_coefficient_.push_back(cytosol->K_kPa() * (1.0 + cytosol->T_d_s()) / target_um3);
    const Random random(0, static_cast<std::uint32_t>(RandomStream::fastest_mode));
    for (std::size_t i = 0; i < n; ++i)
        q_[i] = Vec3(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
    system.friction_product(q_, p_);
    std::fill(p_before_.begin(), p_before_.end(), Vec3::Zero());
    if (!weights.empty()) std::fill(mode_.begin(), mode_.end(), Vec3::Zero());
    double norm = std::sqrt(dot(q_, p_));
    double beta = 0.0;
    rate_per_s_ = 0.0;
    for (int j = 0; j < k_iterations; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            q_[i] /= norm;
            p_[i] /= norm;
        }
        if (!weights.empty())
            for (std::size_t i = 0; i < n; ++i) mode_[i] += weights[idx(j)] * q_[i];
        multiply_stiffness(system);
        diagonal_.push_back(dot(q_, z_));
        const double before = rate_per_s_;
        rate_per_s_ = largest_eigenvalue(diagonal_, off_diagonal_);
        const bool is_enough =
            diagonal_.size() >= k_fewest && rate_per_s_ - before <= k_enough * rate_per_s_;
        if (is_enough || (!weights.empty() && diagonal_.size() == weights.size())) return;
        for (std::size_t i = 0; i < n; ++i)
            r_[i] = z_[i] - diagonal_.back() * p_[i] - beta * p_before_[i];
        std::swap(p_before_, p_);
        std::swap(p_, r_);
        std::fill(q_.begin(), q_.end(), Vec3::Zero());
        // An estimate needs no convergence: what was reached is the next vector.
        static_cast<void>(system.solve_friction(p_, q_, k_solve_tolerance));
        norm = beta = std::sqrt(std::max(0.0, dot(q_, p_)));
        if (beta <= 1e-12 * rate_per_s_) return;  // the whole space was searched
        off_diagonal_.push_back(beta);
    }
}

double FastestMode::rate_per_s(System& system) {
    iterate(system, {});
    return rate_per_s_;
}

Trouble FastestMode::place(System& system) {
    // The eigenvector of the tridiagonal matrix says how the iteration's vectors make up the mode.
    std::vector<double> weights{1.0};
    for (std::size_t j = 0; j + 1 < diagonal_.size(); ++j) {
        const double before = j > 0 ? off_diagonal_[j - 1] * weights[j - 1] : 0.0;
        weights.push_back(((rate_per_s_ - diagonal_[j]) * weights[j] - before) / off_diagonal_[j]);
    }
    iterate(system, weights);
    const Model& model = system.model();
    q_ = mode_;
    system.friction_product(q_, p_);
    multiply_stiffness(system);

    Trouble trouble;
    double largest = 0.0;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const double energy = dot(model.cell_nodes(std::span<const Vec3>(mode_), cell),
                                  model.cell_nodes(std::span<const Vec3>(z_), cell));
        if (trouble.cell < 0 || energy > largest) {
            trouble.cell = cell;
            largest = energy;
        }
    }
    const std::span<const Vec3> u = model.cell_nodes(std::span<const Vec3>(mode_), trouble.cell);
    const Configuration at = system.configuration();
    double largest_of_terms = 0.0, sum_of_terms = 0.0;
    for (const auto& term : system.parts().terms) {
        CellStiffness stiffness;
        if (system.acts(*term)) term->add_stiffness(at, trouble.cell, stiffness);
        std::vector<Vec3> product(u.size(), Vec3::Zero());
        stiffness.add_product(1.0, u, product);
        double energy = dot(u, product);
        if (term.get() == system.parts().cytosol) {
            const double volume =
                dot(u, model.cell_nodes(std::span<const Vec3>(at.geometry.volume_gradient_um2),
                                        trouble.cell));
            energy = system.parts().cytosol->K_kPa() / model.target_volume_um3[idx(trouble.cell)] *
                     volume * volume;
        }
        sum_of_terms += energy;
        if (energy > largest_of_terms) {
            largest_of_terms = energy;
            trouble.term = term->name();
        }
    }
    // What the cell's own terms do not have is in the contacts.
    if (largest - sum_of_terms > largest_of_terms) trouble.term = "contact";

    double largest2 = -1.0;
    const std::vector<MeshTopology::Edge>& edges = model.topology->edges;
    for (const MeshTopology::Edge& edge : edges) {
        const double relative2 = (u[idx(edge.i)] - u[idx(edge.j)]).squaredNorm();
        if (relative2 > largest2) {
            largest2 = relative2;
            trouble.node = edge.i;
            trouble.neighbour = edge.j;
        }
    }
    return trouble;
}

}  // namespace spheroscope
