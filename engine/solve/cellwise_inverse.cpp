#include "engine/solve/cellwise_inverse.hpp"

#include "engine/base/index.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <numeric>

namespace spheroscope {

template <class Vector>
void CellwiseInverse<Vector>::prepare(const VelocitySystem& system, Workers& workers) {
    model_ = &system.model;
    allocate(system);
    const bool has_volume = !system.volume_kPa_s_per_um3.empty();
    denominator_.assign(system.model.radius_um.size(), Scalar{});
    if (has_volume) inverse_times_gradient_.resize(system.model.n_all_nodes());
    workers.loop(system.model.n_cells(), [&](int cell) {
        prepare_cell(system, cell);
        if (!has_volume) return;
        const double coefficient = system.volume_kPa_s_per_um3[idx(cell)];
        if (coefficient == 0.0) return;
        const std::span<const Vector> gradient = system.volume_gradient<Vector>(cell);
        const std::span<Vector> w =
            system.model.cell_nodes(std::span<Vector>(inverse_times_gradient_), cell);
        apply_base(cell, gradient, w);
        Scalar sum{};
        for (std::size_t i = 0; i < w.size(); ++i) sum += gradient[i].dot(w[i]);
        denominator_[idx(cell)] = static_cast<Scalar>(1.0 / coefficient) + sum;
    });
    prepare_coupling(system, workers);
}

template <class Vector> void CellwiseInverse<Vector>::apply(int cell, std::span<const Vector> r,
                                                            std::span<Vector> z) const {
    const Scalar denominator = denominator_[idx(cell)];
    if (denominator == Scalar{}) return apply_base(cell, r, z);
    const std::span<const Vector> w =
        model_->cell_nodes(std::span<const Vector>(inverse_times_gradient_), cell);
    Scalar sum{};  // before r is written over, which z may be
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i].dot(r[i]);
    const Scalar strength = sum / denominator;
    apply_base(cell, r, z);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] -= strength * w[i];
}

void BlockJacobi::allocate(const VelocitySystem& system) {
    model_ = &system.model;
    const std::size_t n_cells = system.model.radius_um.size();
    inverse_.resize(system.model.n_all_nodes());
    trace_.resize(n_cells);
    middle_um_.resize(n_cells);
    resistance_.resize(n_cells);
    motions_.leave_out();
}

void BlockJacobi::prepare_cell(const VelocitySystem& system, int cell) {
    const std::span<const double> drag = system.model.cell_nodes(system.drag_nN_s_per_um, cell);
    const std::span<const Vec3> x = system.model.cell_nodes(system.x_um, cell);
    thread_local std::vector<Mat3> blocks;
    blocks.resize(drag.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = drag[i] * Mat3::Identity();
    if (!system.pairs.empty()) system.pairs.add_diagonal(cell, system.contacts, blocks);
    // so far they hold the nodes against all that is not their cell
    Vec3 middle = Vec3::Zero();
    for (const Vec3& node : x) middle += node;
    middle /= static_cast<double>(x.size());
    Mat3 resistance = Mat3::Zero();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Vec3 arm = middle - x[i];
        const Mat3 from_left = blocks[i].colwise().cross(arm);
        resistance += from_left.rowwise().cross(arm.transpose());
    }
    middle_um_[idx(cell)] = middle;
    resistance_[idx(cell)] = resistance;

    system.cells->add_diagonal(cell, blocks);
    const std::span<std::array<Lanes, 3>> out =
        system.model.cell_nodes(std::span<std::array<Lanes, 3>>(inverse_), cell);
    double trace = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Mat3 inverse = blocks[i].inverse();
        out[i] = {Lanes(Vec3(inverse.col(0))), Lanes(Vec3(inverse.col(1))),
                  Lanes(Vec3(inverse.col(2)))};
        trace += blocks[i].trace();
    }
    trace_[idx(cell)] = trace;
}

void BlockJacobi::prepare_coupling(const VelocitySystem& system, Workers& workers) {
    const double n_cells = static_cast<double>(trace_.size());
    const double cortex = 6.0 * system.edge_nN_s_per_um *
                          static_cast<double>(system.model.topology->edges.size()) * n_cells;
    const double drag =
        3.0 * std::accumulate(system.drag_nN_s_per_um.begin(), system.drag_nN_s_per_um.end(), 0.0);
    const double trace = std::accumulate(trace_.begin(), trace_.end(), 0.0);
    if (trace >= stiff_ * (drag + cortex))
        motions_.prepare(system, middle_um_, resistance_, workers);
}

void BlockJacobi::apply_base(int cell, std::span<const Lanes> r, std::span<Lanes> z) const {
    const std::span<const std::array<Lanes, 3>> inverse =
        model_->cell_nodes(std::span<const std::array<Lanes, 3>>(inverse_), cell);
    const bool turns = motions_.is_in_use();
    const Lanes turning = turns ? motions_.turning(cell, r) : Lanes{};  // z may be r
    for (std::size_t i = 0; i < r.size(); ++i) {
        const Lanes::Register v = r[i].lane;
        z[i] = v[0] * inverse[i][0] + v[1] * inverse[i][1] + v[2] * inverse[i][2];
    }
    if (turns) motions_.add_turning(cell, turning, z);
}

template <class Vector> void CortexInverse<Vector>::allocate(const VelocitySystem& system) {
    if (!factors_.empty()) return;  // the constant part: once per run
    const Model& model = system.model;
    std::map<double, std::size_t> known;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const auto [it, is_new] = known.try_emplace(model.radius_um[idx(cell)], factors_.size());
        if (is_new)
            factors_.push_back(std::make_unique<CortexFactor>(
                *model.topology, model.cell_nodes(system.drag_nN_s_per_um, cell),
                system.edge_nN_s_per_um));
        factor_of_cell_.push_back(it->second);
    }
}

template <class Vector> void CortexInverse<Vector>::apply_base(int cell, std::span<const Vector> r,
                                                               std::span<Vector> z) const {
    thread_local std::vector<Vector> work;
    work.resize(r.size());
    factors_[factor_of_cell_[idx(cell)]]->solve(r, z, std::span<Vector>(work));
}

template <class Vector> void DragInverse<Vector>::apply_base(int cell, std::span<const Vector> r,
                                                             std::span<Vector> z) const {
    using Number = typename VectorTraits<Vector>::Scalar;
    const std::span<const double> drag = model_->cell_nodes(drag_nN_s_per_um_, cell);
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = static_cast<Number>(1.0 / drag[i]) * r[i];
}

template class CellwiseInverse<Vec3>;
template class CellwiseInverse<Lanes>;
template class CortexInverse<Vec3>;
template class CortexInverse<Lanes>;
template class DragInverse<Vec3>;
template class DragInverse<Lanes>;

}  // namespace spheroscope
