#include "engine/solve/conjugate_gradients.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spheroscope {
namespace {

/// Smallest share to which one pass of single-precision iterations reduces a residual. Its own
/// residual, updated and not computed anew, strays from the true one by some 1e-6.
constexpr double k_reduction_per_pass = 1e-4;
/// From this tolerance on also the residual of the start may be computed in single precision: it is
/// then wrong by some 1e-6 of |b|.
constexpr double k_rough = 1e-3;
/// A pass that does not even do this has met the end of double precision.
constexpr double k_progress_per_pass = 0.5;

/// Sums of four lanes at a time; one cell is too small for the rounding of single precision to
/// matter at k_reduction_per_pass.
class LaneSum {
  public:
    void add(std::size_t i, Lanes a, Lanes b) { sum_[i % sum_.size()] += a.lane * b.lane; }
    [[nodiscard]] double total() const {
        double total = 0.0;
        for (const Lanes::Register& s : sum_)
            for (int k = 0; k < 3; ++k) total += static_cast<double>(s[k]);
        return total;
    }

  private:
    std::array<Lanes::Register, 4> sum_{};
};

double total(const std::vector<double>& per_cell) {
    return std::accumulate(per_cell.begin(), per_cell.end(), 0.0);
}

}  // namespace

/// One member's part of a solve.
class ConjugateGradients::Solve {
  public:
    Solve(ConjugateGradients& arrays, const VelocitySystem& system,
          const Preconditioner& preconditioner, std::span<const Vec3> b, std::span<Vec3> x,
          Workers::Member& member)
        : arrays_(arrays), system_(system), preconditioner_(preconditioner), b_(b), x_(x),
          member_(member), teams_(system.teams()),
          own_teams_(teams_.share(member)), cells_{first_cell_of(own_teams_.begin),
                                                   first_cell_of(own_teams_.end)},
          groups_(member.share(system.n_groups())), motions_(preconditioner.rigid_motions()),
          translations_(arrays.translations_[idx(member.index())]) {}

    SolveOutcome run(double tolerance, int largest_iterations) {
        SolveOutcome outcome;
        if (tolerance >= k_rough)
            residual_in_single();
        else
            residual_in_double();
        const double bb = bb_ = total(arrays_.sum_bb_);
        record();
        const double enough = tolerance * tolerance * bb;
        // A residual that is not a number fails all tests and leaves as 'not converged'.
        while (rr_ > enough && outcome.iterations < largest_iterations) {
            const double start = rr_;
            const double smallest = k_reduction_per_pass * k_reduction_per_pass * start;
            outcome.iterations +=
                iterate(std::max(enough, smallest), largest_iterations - outcome.iterations);
            add_correction();
            if (enough >= smallest) break;
            residual_in_double();
            if (!(rr_ < k_progress_per_pass * start)) break;
        }
        // Forces beyond all numbers: then everything is small beside them.
        outcome.converged = rr_ <= enough && std::isfinite(bb);
        outcome.relative_residual = bb > 0.0 ? std::sqrt(rr_ / bb) : 0.0;
        return outcome;
    }

  private:
    [[nodiscard]] int first_cell_of(int team) const {
        return team < teams_.n_teams() ? teams_.cells_of(team).begin : system_.model.n_cells();
    }
    template <class Array> auto of_cell(Array& values, int cell) const {
        return system_.model.cell_nodes(std::span(values), cell);
    }

    template <class V> void multiply_groups(std::span<const V> u) {
        for (int g = groups_.begin; g < groups_.end; ++g) system_.product_of_group(g, u);
        member_.wait();
    }
    template <class V> void multiply_teams(std::span<const V> u, std::span<V> out) {
        for (int team = own_teams_.begin; team < own_teams_.end; ++team)
            system_.product_of_team(team, u, out);
    }

    /// z = B r, and the sums of r with z and with itself. The part of z that moves cells as wholes
    /// follows when all of them are there: find_translations().
    void precondition(int cell) {
        const std::span<Lanes> r = of_cell(arrays_.residual_, cell);
        const std::span<Lanes> z = of_cell(arrays_.preconditioned_, cell);
        preconditioner_.apply(cell, r, z);
        LaneSum rz, rr;
        for (std::size_t i = 0; i < r.size(); ++i) {
            rz.add(i, r[i], z[i]);
            rr.add(i, r[i], r[i]);
        }
        if (motions_ != nullptr) {
            Lanes force;
            for (const Lanes& of_node : r) force += of_node;
            for (int k = 0; k < 3; ++k)
                arrays_.sum_r_[idx(3 * cell + k)] = static_cast<double>(force.lane[k]);
        }
        arrays_.sum_rz_[idx(cell)] = rz.total();
        arrays_.sum_rr_[idx(cell)] = rr.total();
    }

    /// r.z of all cells, after a barrier. Every member finds the translations for itself: that
    /// takes less than another barrier, and gives the same bits.
    double find_translations() {
        double rz = total(arrays_.sum_rz_);
        if (motions_ == nullptr) return rz;
        motions_->translations(arrays_.sum_r_, translations_.of_cells, translations_.work);
        for (std::size_t k = 0; k < arrays_.sum_r_.size(); ++k)
            rz += arrays_.sum_r_[k] * translations_.of_cells[k];
        return rz;
    }
    Lanes translation(int cell) const {
        if (motions_ == nullptr) return {};
        const double* const v = &translations_.of_cells[idx(3 * cell)];
        return Lanes(Vec3(v[0], v[1], v[2]));
    }

    /// r = b - A x; correction = 0.
    void residual_in_double() {
        multiply_groups(std::span<const Vec3>(x_));
        multiply_teams(std::span<const Vec3>(x_), std::span<Vec3>(arrays_.exact_product_));
        for (int cell = cells_.begin; cell < cells_.end; ++cell) {
            const std::span<const Vec3> q = of_cell(arrays_.exact_product_, cell);
            const std::span<Lanes> r = of_cell(arrays_.residual_, cell);
            const std::span<Lanes> correction = of_cell(arrays_.correction_, cell);
            const std::span<const Vec3> b = system_.model.cell_nodes(b_, cell);
            double bb = 0.0, rr = 0.0;
            for (std::size_t i = 0; i < r.size(); ++i) {
                const Vec3 residual = b[i] - q[i];
                r[i] = Lanes(residual);
                correction[i] = Lanes::zero();
                bb += b[i].squaredNorm();
                rr += residual.squaredNorm();
            }
            precondition(cell);
            arrays_.sum_bb_[idx(cell)] = bb;
            arrays_.sum_rr_[idx(cell)] = rr;  // also where single precision would be zero
        }
        member_.wait();
        rr_ = total(arrays_.sum_rr_);
        rz_ = find_translations();
    }

    void residual_in_single() {
        for (int cell = cells_.begin; cell < cells_.end; ++cell) {
            const std::span<const Vec3> x =
                system_.model.cell_nodes(std::span<const Vec3>(x_), cell);
            std::transform(x.begin(), x.end(), of_cell(arrays_.direction_, cell).begin(),
                           [](const Vec3& v) { return Lanes(v); });
        }
        member_.wait();
        const std::span<const Lanes> start(arrays_.direction_);
        multiply_groups(start);
        multiply_teams(start, std::span<Lanes>(arrays_.product_));
        for (int cell = cells_.begin; cell < cells_.end; ++cell) {
            const std::span<Lanes> r = of_cell(arrays_.residual_, cell);
            const std::span<const Lanes> q = of_cell(arrays_.product_, cell);
            const std::span<Lanes> correction = of_cell(arrays_.correction_, cell);
            const std::span<const Vec3> b = system_.model.cell_nodes(b_, cell);
            double bb = 0.0;
            for (std::size_t i = 0; i < r.size(); ++i) {
                r[i] = Lanes(b[i]) - q[i];
                correction[i] = Lanes::zero();
                bb += b[i].squaredNorm();
            }
            precondition(cell);
            arrays_.sum_bb_[idx(cell)] = bb;
        }
        member_.wait();
        rr_ = total(arrays_.sum_rr_);
        rz_ = find_translations();
    }

    /// Until |r|^2 <= enough. Returns the iterations.
    int iterate(double enough, int largest_iterations) {
        const std::span<const Lanes> direction(arrays_.direction_);
        float beta = 0.0F;
        int iteration = 0;
        while (rr_ > enough && iteration < largest_iterations) {
            ++iteration;
            for (int cell = cells_.begin; cell < cells_.end; ++cell) {
                const std::span<Lanes> p = of_cell(arrays_.direction_, cell);
                const std::span<const Lanes> z = of_cell(arrays_.preconditioned_, cell);
                const Lanes whole = translation(cell);
                if (iteration == 1)
                    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + whole;
                else
                    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + whole + beta * p[i];
            }
            member_.wait();
            multiply_groups(direction);
            for (int team = own_teams_.begin; team < own_teams_.end; ++team) {
                system_.product_of_team(team, direction, std::span<Lanes>(arrays_.product_));
                const CellTeams::Range cells = teams_.cells_of(team);
                for (int cell = cells.begin; cell < cells.end; ++cell) {
                    const std::span<const Lanes> q = of_cell(arrays_.product_, cell);
                    const std::span<const Lanes> p = of_cell(arrays_.direction_, cell);
                    LaneSum pq;
                    for (std::size_t i = 0; i < q.size(); ++i) pq.add(i, p[i], q[i]);
                    arrays_.sum_pq_[idx(cell)] = pq.total();
                }
            }
            member_.wait();
            const auto alpha = static_cast<float>(rz_ / total(arrays_.sum_pq_));
            for (int cell = cells_.begin; cell < cells_.end; ++cell) {
                const std::span<const Lanes> p = of_cell(arrays_.direction_, cell);
                const std::span<const Lanes> q = of_cell(arrays_.product_, cell);
                const std::span<Lanes> r = of_cell(arrays_.residual_, cell);
                const std::span<Lanes> correction = of_cell(arrays_.correction_, cell);
                for (std::size_t i = 0; i < r.size(); ++i) {
                    correction[i] += alpha * p[i];
                    r[i] -= alpha * q[i];
                }
                precondition(cell);
            }
            member_.wait();
            rr_ = total(arrays_.sum_rr_);
            record();
            const double next_rz = find_translations();
            beta = static_cast<float>(next_rz / rz_);
            rz_ = next_rz;
        }
        return iteration;
    }

    /// What has been reached, for those who want to know.
    void record() const {
        if (arrays_.residuals_ != nullptr && member_.index() == 0)
            arrays_.residuals_->push_back(bb_ > 0.0 ? std::sqrt(rr_ / bb_) : 0.0);
    }

    void add_correction() {
        for (int cell = cells_.begin; cell < cells_.end; ++cell) {
            const std::span<Vec3> x = system_.model.cell_nodes(x_, cell);
            const std::span<const Lanes> correction = of_cell(arrays_.correction_, cell);
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i].vec3();
        }
        member_.wait();
    }

    ConjugateGradients& arrays_;
    const VelocitySystem& system_;
    const Preconditioner& preconditioner_;
    std::span<const Vec3> b_;
    std::span<Vec3> x_;
    Workers::Member& member_;
    CellTeams teams_;
    CellTeams::Range own_teams_;
    Workers::Member::Range cells_, groups_;
    const RigidMotions* motions_;  // or nullptr
    Translations& translations_;
    double bb_ = 0.0, rr_ = 0.0, rz_ = 0.0;  // |b|^2, |r|^2 and r.z, the same for all members
};

SolveOutcome ConjugateGradients::solve(const VelocitySystem& system,
                                       const Preconditioner& preconditioner,
                                       std::span<const Vec3> b, std::span<Vec3> x, double tolerance,
                                       int largest_iterations, Workers& workers) {
    exact_product_.resize(b.size());
    for (HugeVector<Lanes>* v :
         {&correction_, &residual_, &direction_, &product_, &preconditioned_})
        v->resize(b.size());
    for (std::vector<double>* s : {&sum_bb_, &sum_rr_, &sum_rz_, &sum_pq_})
        s->assign(system.model.radius_um.size(), 0.0);
    translations_.resize(idx(workers.size()));
    if (preconditioner.rigid_motions() != nullptr) {
        sum_r_.assign(3 * system.model.radius_um.size(), 0.0);
        for (Translations& t : translations_) {
            t.of_cells.resize(sum_r_.size());
            t.work.resize(sum_r_.size());
        }
    }
    if (residuals_ != nullptr) residuals_->clear();
    SolveOutcome outcome;
    workers.region([&](Workers::Member& member) {
        const SolveOutcome own =
            Solve(*this, system, preconditioner, b, x, member).run(tolerance, largest_iterations);
        if (member.index() == 0) outcome = own;
    });
    return outcome;
}

}  // namespace spheroscope
