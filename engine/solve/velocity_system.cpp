#include "engine/solve/velocity_system.hpp"

#include "engine/friction/cortex_viscosity.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <map>

namespace spheroscope {
namespace {
std::size_t idx(int i) { return static_cast<std::size_t>(i); }

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}
}  // namespace

void VelocitySystem::product_of_cell(int cell, std::span<const Vec3> u_all,
                                     std::span<Vec3> out) const {
    const std::span<const Vec3> u = model.cell_nodes(u_all, cell);
    const std::span<const double> d = model.cell_nodes(drag, cell);
    for (std::size_t i = 0; i < u.size(); ++i) out[i] = d[i] * u[i];
    if (edge_friction > 0.0) add_cortex_friction(*model.topology, edge_friction, u, out);
    if (!stiffness.empty()) stiffness[idx(cell)].add_product(dt_s, u, out);
    if (!volume_coefficient.empty()) {
        const std::span<const Vec3> s = model.cell_nodes(volume_gradient, cell);
        const double strength = volume_coefficient[idx(cell)] * dot(s, u);
        for (std::size_t i = 0; i < u.size(); ++i) out[i] += strength * s[i];
    }
    if (!pairs.empty()) pairs.add_to_cell(cell, contacts, out);
}

void VelocitySystem::product(std::span<const Vec3> u, std::span<Vec3> out, Workers& workers) const {
    workers.loop(n_groups(), [&](int group) { product_of_group(group, u); });
    workers.loop(model.n_cells(),
                 [&](int cell) { product_of_cell(cell, u, model.cell_nodes(out, cell)); });
}

void Preconditioner::prepare(const VelocitySystem& system, Workers& workers) {
    model_ = &system.model;
    allocate(system);
    const bool has_volume = !system.volume_coefficient.empty();
    denominator_.assign(system.model.radius_um.size(), 0.0);
    if (has_volume) inverse_times_gradient_.resize(system.model.n_all_nodes());
    workers.loop(system.model.n_cells(), [&](int cell) {
        prepare_cell(system, cell);
        if (!has_volume) return;
        const double coefficient = system.volume_coefficient[idx(cell)];
        if (coefficient == 0.0) return;
        const std::span<const Vec3> s = system.model.cell_nodes(system.volume_gradient, cell);
        const std::span<Vec3> w =
            system.model.cell_nodes(std::span<Vec3>(inverse_times_gradient_), cell);
        apply_base(cell, s, w);
        denominator_[idx(cell)] = 1.0 / coefficient + dot(s, w);
    });
}

void Preconditioner::apply(int cell, std::span<const Vec3> r, std::span<Vec3> z) const {
    apply_base(cell, r, z);
    const double denominator = denominator_[idx(cell)];
    if (denominator == 0.0) return;
    const std::span<const Vec3> w =
        model_->cell_nodes(std::span<const Vec3>(inverse_times_gradient_), cell);
    const double strength = dot(w, r) / denominator;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] -= strength * w[i];
}

void BlockJacobi::allocate(const VelocitySystem& system) {
    model_ = &system.model;
    inverse_.resize(system.model.n_all_nodes());
}

void BlockJacobi::prepare_cell(const VelocitySystem& system, int cell) {
    const MeshTopology& mesh = *system.model.topology;
    const std::span<Mat3> blocks = system.model.cell_nodes(std::span<Mat3>(inverse_), cell);
    const std::span<const double> drag = system.model.cell_nodes(system.drag, cell);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const int degree = mesh.neighbour_begin[i + 1] - mesh.neighbour_begin[i];
        blocks[i] = (drag[i] + system.edge_friction * degree) * Mat3::Identity();
    }
    if (!system.stiffness.empty()) system.stiffness[idx(cell)].add_diagonal(system.dt_s, blocks);
    if (!system.pairs.empty())
        system.pairs.add_diagonal(cell, system.contacts, system.dt_s, blocks);
    for (Mat3& block : blocks) block = block.inverse().eval();
}

void BlockJacobi::apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const {
    const std::span<const Mat3> inverse = model_->cell_nodes(std::span<const Mat3>(inverse_), cell);
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = inverse[i] * r[i];
}

void CortexPreconditioner::allocate(const VelocitySystem& system) {
    if (!factors_.empty()) return;  // the constant part: once per run
    const Model& model = system.model;
    std::map<double, std::size_t> known;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const auto [it, is_new] = known.try_emplace(model.radius_um[idx(cell)], factors_.size());
        if (is_new)
            factors_.push_back(std::make_unique<CortexFactor>(
                *model.topology, model.cell_nodes(system.drag, cell), system.edge_friction));
        factor_of_cell_.push_back(it->second);
    }
}

void CortexPreconditioner::apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const {
    thread_local std::vector<Vec3> work;
    work.resize(r.size());
    factors_[factor_of_cell_[idx(cell)]]->solve(r, z, work);
}

void DragPreconditioner::apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const {
    const std::span<const double> drag = model_->cell_nodes(drag_, cell);
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = r[i] / drag[i];
}

}  // namespace spheroscope
