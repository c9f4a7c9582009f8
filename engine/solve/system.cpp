#include "engine/solve/system.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spheroscope {
namespace {

/// More iterations than this mean that the matrix is broken, not that the problem is hard: a cell's
/// friction matrix has a condition number of some hundreds.
constexpr int k_largest_iterations = 2000;

/// The solvers add up squares of forces in single precision, which ends at 3e38. Cells have forces
/// of some nN.
constexpr double k_too_large_nN = 1e15;

bool can_be_computed_with(const Vec3& force_nN) {
    return std::abs(force_nN.x()) < k_too_large_nN && std::abs(force_nN.y()) < k_too_large_nN &&
           std::abs(force_nN.z()) < k_too_large_nN;  // false for what is not a number
}

}  // namespace

std::string Trouble::text() const {
    std::string text = what;
    if (!term.empty()) text += " from " + term;
    if (loc.line > 0) text += " (" + loc.text() + ")";
    if (cell >= 0) text += ", cell " + std::to_string(cell);
    if (neighbour >= 0)
        text += ", edge " + std::to_string(node) + "-" + std::to_string(neighbour);
    else if (node >= 0)
        text += ", node " + std::to_string(node);
    return text;
}

System::System(Model model, SystemParts parts, int n_threads, Need also)
    : model_(std::move(model)), parts_(std::move(parts)), workers_(n_threads), needs_(also),
      couplings_(*model_.topology) {
    for (const auto& term : parts_.terms) {
        needs_ = needs_ | term->needs();
        work_.terms.push_back({std::string(term->name()), 0});
    }
    if (parts_.contact) {
        if (parts_.contact->form == ContactForm::variational)
            variational_search_.emplace(*parts_.contact);
        else
            search_.emplace(*parts_.contact, parts_.contact_precision);
        needs_ = needs_ | Need::contacts | Need::triangles;
    }
    allocate(now_);
    cell_is_finite_.resize(model_.radius_um.size());
    drag_ = node_drags(model_, parts_.frictions.eta_f_kPa_s);
    if (parts_.cytosol != nullptr && parts_.cytosol->T_d_s() > 0.0)
        for (const double target_um3 : model_.target_volume_um3)
            volume_friction_.push_back(parts_.cytosol->K_kPa() * parts_.cytosol->T_d_s() /
                                       target_um3);
}

void System::allocate(Evaluation& evaluation) const {
    evaluation.geometry.allocate(model_, needs_);
    evaluation.contacts.clear(model_.n_cells());
    evaluation.force_nN.resize(model_.n_all_nodes());
}

std::optional<Trouble> System::evaluate(std::span<const Vec3> x_um,
                                        std::span<const double> volume_integral_s,
                                        double wall_radius_um, const Load& load) {
    const auto same_bits = [](const auto& kept, const auto& asked) {
        return kept.size() == asked.size() &&
               std::memcmp(kept.data(), asked.data(), asked.size_bytes()) == 0;
    };
    // Measures look at a configuration just before a method starts from it; comparing costs a
    // thousandth of evaluating.
    if (now_.is_valid && wall_radius_um == now_.wall_radius_um && load == now_.load &&
        same_bits(now_.x_um, x_um) && same_bits(now_.volume_integral_s, volume_integral_s)) {
        if (witness_ != nullptr) witness_->evaluated(*this);
        return {};
    }
    if (now_.force_nN.empty()) allocate(now_);  // the first time that another one lies aside
    now_.is_valid = false;
    now_.x_um.assign(x_um.begin(), x_um.end());
    now_.volume_integral_s.assign(volume_integral_s.begin(), volume_integral_s.end());
    now_.wall_radius_um = wall_radius_um;
    now_.load = load;
    now_.pairs.clear();
    now_.has_pairs = false;
    now_.assembled_dt_s = 0.0;
    now_.volume_gradient_in_single.clear();
    if (needs_ != Need::none)
        workers_.loop(model_.n_cells(), [&](int cell) {
            now_.geometry.compute_cell(model_, now_.x_um, needs_, cell);
        });
    if (search_) search_->find(model_, now_.x_um, now_.geometry, workers_, now_.contacts);
    if (variational_search_)
        variational_search_->find(model_, now_.x_um, now_.geometry, workers_, now_.contacts);
    if (parts_.contact) ++work_.contact_searches;
    const Configuration at = configuration();
    workers_.loop(model_.n_cells(), [&](int cell) {
        const std::span<Vec3> F = model_.cell_nodes(std::span<Vec3>(now_.force_nN), cell);
        std::fill(F.begin(), F.end(), Vec3::Zero());
        for (const auto& term : parts_.terms)
            if (acts(*term)) term->add_force(at, cell, F);
        cell_is_finite_[idx(cell)] = std::all_of(F.begin(), F.end(), can_be_computed_with) ? 1 : 0;
    });
    ++work_.force_evaluations;
    for (std::size_t t = 0; t < parts_.terms.size(); ++t)
        if (acts(*parts_.terms[t])) ++work_.terms[t].evaluations;
    if (std::find(cell_is_finite_.begin(), cell_is_finite_.end(), 0) != cell_is_finite_.end())
        return find_trouble();
    now_.is_valid = true;
    if (witness_ != nullptr) witness_->evaluated(*this);
    return {};
}

void System::assemble(double dt_s) {
    if (now_.assembled_dt_s == dt_s) return;
    const double contact_kPa_s_per_um = parts_.contact ? dt_s * parts_.contact->k_kPa_per_um : 0.0;
    if (parts_.contact)
        now_.pairs.build(model_, now_.contacts, parts_.frictions.contact, contact_kPa_s_per_um,
                         workers_);
    now_.has_pairs = true;
    now_.cells.allocate(couplings_, model_.n_cells());
    workers_.loop(now_.cells.teams().n_teams(), [&](int team) {
        thread_local std::array<CellMatrix, CellTeams::k_members> matrices;
        const CellTeams::Range cells = now_.cells.teams().cells_of(team);
        const std::span<CellMatrix> of_team =
            std::span(matrices).first(idx(cells.end - cells.begin));
        for (int cell = cells.begin; cell < cells.end; ++cell)
            assemble_cell(cell, dt_s, of_team[idx(cell - cells.begin)]);
        now_.cells.set(team, of_team);
    });
    now_.assembled_dt_s = dt_s;
    ++work_.stiffness_evaluations;
}

void System::assemble_cell(int cell, double dt_s, CellMatrix& matrix) const {
    thread_local CellStiffness K;
    K.clear();
    const Configuration at = configuration();
    for (const auto& term : parts_.terms)
        if (acts(*term)) term->add_stiffness(at, cell, K);
    matrix.clear(couplings_);
    matrix.add(K, dt_s);
    if (parts_.frictions.edge_nN_s_per_um > 0.0)
        matrix.add_laplacian(*model_.topology, parts_.frictions.edge_nN_s_per_um);
    if (parts_.contact)
        ContactOperator::add_own_stiffness(cell, now_.contacts, dt_s * parts_.contact->k_kPa_per_um,
                                           matrix);
}

void System::assemble_friction() {
    if (now_.has_pairs || !parts_.frictions.contact) return;
    now_.pairs.build(model_, now_.contacts, parts_.frictions.contact, 0.0, workers_);
    now_.has_pairs = true;
}

std::optional<Trouble> System::find_trouble() {
    const auto first = std::find(cell_is_finite_.begin(), cell_is_finite_.end(), 0);
    const int cell = static_cast<int>(first - cell_is_finite_.begin());
    const Configuration at = configuration();
    for (const auto& term : parts_.terms) {
        if (!acts(*term)) continue;
        std::vector<Vec3> F(idx(model_.n_nodes()), Vec3::Zero());
        term->add_force(at, cell, F);
        for (std::size_t i = 0; i < F.size(); ++i)
            if (!can_be_computed_with(F[i]))
                return Trouble{F[i].allFinite() ? "the force is too large to compute with"
                                                : "the force is not finite",
                               std::string(term->name()), cell, static_cast<int>(i), term->loc()};
    }
    return Trouble{"the sum of forces is not finite", "", cell, -1, {}};
}

Configuration System::configuration() const {
    return {model_,        now_.x_um,     now_.volume_integral_s,
            now_.geometry, now_.contacts, now_.wall_radius_um,
            now_.load};
}

double System::energy_fJ() {
    const Configuration at = configuration();
    std::vector<double> per_cell(model_.radius_um.size(), 0.0);
    workers_.loop(model_.n_cells(), [&](int cell) {
        for (const auto& term : parts_.terms)
            if (acts(*term)) per_cell[idx(cell)] += term->energy_fJ(at, cell).value_or(0.0);
    });
    double sum_fJ = 0.0;
    for (const double energy_fJ : per_cell) sum_fJ += energy_fJ;
    return sum_fJ;
}

std::vector<Vec3> System::force_of_term(const ForceTerm& term) {
    const Configuration at = configuration();
    std::vector<Vec3> F(model_.n_all_nodes(), Vec3::Zero());
    if (acts(term))
        workers_.loop(model_.n_cells(), [&](int cell) {
            term.add_force(at, cell, model_.cell_nodes(std::span<Vec3>(F), cell));
        });
    return F;
}

VelocitySystem System::velocity_system(double dt_s, std::span<const double> volume_kPa_s_per_um3) {
    if (dt_s > 0.0)
        assemble(dt_s);
    else
        assemble_friction();
    if (!volume_kPa_s_per_um3.empty() && now_.volume_gradient_in_single.empty())
        for (const Vec3& S : now_.geometry.volume_gradient_um2)
            now_.volume_gradient_in_single.emplace_back(S);
    return {model_,
            now_.contacts,
            drag_,
            parts_.frictions.edge_nN_s_per_um,
            now_.pairs,
            dt_s > 0.0 ? &now_.cells : nullptr,
            volume_kPa_s_per_um3,
            now_.geometry.volume_gradient_um2,
            now_.volume_gradient_in_single,
            now_.x_um};
}

void System::friction_product(std::span<const Vec3> u, std::span<Vec3> out) {
    velocity_system(0.0, volume_friction_).product(u, out, workers_);
}

SolveOutcome System::solve_friction(std::span<const Vec3> b, std::span<Vec3> v, double tolerance) {
    const VelocitySystem system = velocity_system(0.0, volume_friction_);
    const FrictionShape shape = friction_shape();
    const bool has_cortex = parts_.frictions.edge_nN_s_per_um > 0.0;
    if (shape != FrictionShape::changing) {
        // No cell is coupled to another one: inverting the cells is the whole solution.
        if (!friction_inverse_) {
            if (has_cortex)
                friction_inverse_ = std::make_unique<CortexInverse<Vec3>>();
            else
                friction_inverse_ = std::make_unique<DragInverse<Vec3>>();
        }
        friction_inverse_->prepare(system, workers_);
        workers_.loop(model_.n_cells(), [&](int cell) {
            friction_inverse_->apply(cell, model_.cell_nodes(b, cell), model_.cell_nodes(v, cell));
        });
        if (const auto* cortex = dynamic_cast<CortexInverse<Vec3>*>(friction_inverse_.get()))
            work_.factorisations = cortex->factorisations();
        if (shape == FrictionShape::fixed) ++work_.direct_solves;
        if (witness_ != nullptr) witness_->solved({0.0, {}, true});
        return {true, 0, 0.0};
    }
    if (!friction_preconditioner_) {
        if (has_cortex)
            friction_preconditioner_ = std::make_unique<CortexInverse<Lanes>>();
        else
            friction_preconditioner_ = std::make_unique<DragInverse<Lanes>>();
    }
    friction_preconditioner_->prepare(system, workers_);
    if (const auto* cortex = dynamic_cast<CortexInverse<Lanes>*>(friction_preconditioner_.get()))
        work_.factorisations = cortex->factorisations();
    return iterate(system, *friction_preconditioner_, 0.0, b, v, tolerance);
}

SolveOutcome System::solve_implicit(double dt_s, std::span<const double> volume_kPa_s_per_um3,
                                    std::span<const Vec3> b, std::span<Vec3> v, double tolerance) {
    const VelocitySystem system = velocity_system(dt_s, volume_kPa_s_per_um3);
    if (!implicit_preconditioner_) implicit_preconditioner_ = std::make_unique<BlockJacobi>();
    implicit_preconditioner_->prepare(system, workers_);
    return iterate(system, *implicit_preconditioner_, dt_s, b, v, tolerance);
}

SolveOutcome System::iterate(const VelocitySystem& system, const Preconditioner& preconditioner,
                             double dt_s, std::span<const Vec3> b, std::span<Vec3> v,
                             double tolerance) {
    if (!conjugate_gradients_) conjugate_gradients_ = std::make_unique<ConjugateGradients>();
    SolveHistory history{dt_s, {}, false};
    conjugate_gradients_->record_residuals(witness_ != nullptr ? &history.residual : nullptr);
    const SolveOutcome outcome = conjugate_gradients_->solve(
        system, preconditioner, b, v, tolerance, k_largest_iterations, workers_);
    conjugate_gradients_->record_residuals(nullptr);
    ++work_.linear_solves;
    work_.linear_iterations += outcome.iterations;
    history.converged = outcome.converged;
    if (witness_ != nullptr) witness_->solved(history);
    return outcome;
}

Work System::work() const {
    Work work = work_;
    if (parts_.contact) {
        const ContactSearch::Counts& counts =
            search_ ? search_->counts() : variational_search_->counts();
        work.contact_candidates = counts.candidates;
        work.contact_pairs = counts.active_pairs;
        work.contact_too_deep = counts.too_deep;
    }
    return work;
}

}  // namespace spheroscope
