#include "engine/solve/rigid_motions.hpp"

#include "engine/base/index.hpp"

#include <Eigen/LU>

namespace spheroscope {
namespace {

Lanes cross(Lanes a, Lanes b) {
    using Register = Lanes::Register;
    const auto turned = [](Register r) { return __builtin_shufflevector(r, r, 1, 2, 0, 3); };
    return Lanes(turned(a.lane * turned(b.lane) - turned(a.lane) * b.lane));
}

}  // namespace

void RigidMotions::prepare(const VelocitySystem& system, std::span<const Vec3> middle_um,
                           std::span<const Mat3> resistance, Workers& workers) {
    model_ = &system.model;
    arm_um_.resize(system.model.n_all_nodes());
    compliance_.resize(middle_um.size());
    of_pairs_.resize(idx(system.n_groups()));
    workers.loop(system.model.n_cells(), [&](int cell) {
        const std::span<const Vec3> x = system.model.cell_nodes(system.x_um, cell);
        const std::span<Lanes> arm = system.model.cell_nodes(std::span<Lanes>(arm_um_), cell);
        thread_local std::vector<Vec3> from_middle;
        from_middle.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            from_middle[i] = x[i] - middle_um[idx(cell)];
            arm[i] = Lanes(from_middle[i]);
        }
        const Mat3 inverse =
            (resistance[idx(cell)] + system.cells->against_rotation(cell, from_middle)).inverse();
        for (int k = 0; k < 3; ++k) compliance_[idx(cell)][idx(k)] = Lanes(Vec3(inverse.col(k)));
    });
    workers.loop(system.n_groups(), [&](int g) { of_pairs_[idx(g)] = system.pairs.sum_of(g); });
    is_in_use_ = factor_translations(system);
}

bool RigidMotions::factor_translations(const VelocitySystem& system) {
    std::vector<Mat3> own(idx(system.model.n_cells()), Mat3::Zero());
    for (int cell = 0; cell < system.model.n_cells(); ++cell) {
        double drag = 0.0;
        for (const double of_node : system.model.cell_nodes(system.drag_nN_s_per_um, cell))
            drag += of_node;
        own[idx(cell)].diagonal().setConstant(drag);
        own[idx(cell)] += system.cells->against_translation(cell);
    }
    std::vector<SparseCholesky::Entry> entries;
    const auto put = [&](int a, int b, const Mat3& block) {  // a >= b
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                if (3 * a + row >= 3 * b + column)
                    entries.push_back({3 * a + row, 3 * b + column, block(row, column)});
    };
    for (std::size_t g = 0; g < of_pairs_.size(); ++g) {
        const Contacts::Group& group = system.contacts.groups[g];
        own[idx(group.cell_a)] += of_pairs_[g];
        own[idx(group.cell_b)] += of_pairs_[g];
        put(group.cell_b, group.cell_a, -of_pairs_[g]);
    }
    for (int cell = 0; cell < system.model.n_cells(); ++cell) put(cell, cell, own[idx(cell)]);
    return coupled_.factor(3 * system.model.n_cells(), entries);
}

Lanes RigidMotions::turning(int cell, std::span<const Lanes> r) const {
    const std::span<const Lanes> arm = model_->cell_nodes(std::span<const Lanes>(arm_um_), cell);
    Lanes torque;
    for (std::size_t i = 0; i < r.size(); ++i) torque += cross(arm[i], r[i]);
    const std::array<Lanes, 3>& C = compliance_[idx(cell)];
    return torque.lane[0] * C[0] + torque.lane[1] * C[1] + torque.lane[2] * C[2];
}

void RigidMotions::add_turning(int cell, Lanes turning, std::span<Lanes> z) const {
    const std::span<const Lanes> arm = model_->cell_nodes(std::span<const Lanes>(arm_um_), cell);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += cross(turning, arm[i]);
}

}  // namespace spheroscope
