#pragma once

#include "engine/solve/cell_matrices.hpp"
#include "engine/solve/contact_operator.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace spheroscope {

/// The linear system of one step, (Gamma + dt K) v = b:
///
///   Gamma = drag (diagonal) + cortex (the mesh's Laplacian, shared by all cells) + contacts
///   K     = the cells' own terms + contacts (k S n n^T per pair of triangles)
///
/// and per cell one rank-one part, coefficient * S S^T with S = dV/dx: the derivative part of the
/// volume controller, and in an implicit method its stiffness. Gamma alone is never assembled but
/// for its contacts; with dt K there are the cells' matrices, which have the cortex in them.
struct VelocitySystem {
    const Model& model;
    const Contacts& contacts;
    std::span<const double> drag_nN_s_per_um;      ///< [all nodes]
    double edge_nN_s_per_um = 0.0;                 ///< 0: absent
    ContactOperator& pairs;                        ///< empty without contact friction and stiffness
    const CellMatrices* cells = nullptr;           ///< null: Gamma alone
    std::span<const double> volume_kPa_s_per_um3;  ///< [cells], or empty: no rank-one part
    std::span<const Vec3> volume_gradient_um2;     ///< S [all nodes]
    std::span<const Lanes> volume_gradient_in_single;  ///< the same, for products in Lanes
    std::span<const Vec3> x_um;                        ///< [all nodes]

    [[nodiscard]] int n_groups() const { return pairs.n_groups(); }
    [[nodiscard]] CellTeams teams() const { return CellTeams(model.n_cells()); }
    /// A product is product_of_group for all groups, a barrier, then product_of_team for all teams
    /// of cells. Vector: Vec3 or Lanes.
    template <class Vector> void product_of_group(int group, std::span<const Vector> u) const {
        pairs.product_of_group(group, model,
                               cells == nullptr ? ContactOperator::Part::friction
                                                : ContactOperator::Part::friction_and_stiffness,
                               u);
    }
    /// out [all nodes] = row blocks of the team's cells times u [all nodes].
    template <class Vector>
    void product_of_team(int team, std::span<const Vector> u, std::span<Vector> out) const;
    /// The whole product, for tests, diagnostics and starts.
    void product(std::span<const Vec3> u, std::span<Vec3> out, Workers& workers) const;
    /// S of one cell, in the precision of the vectors that it is multiplied with.
    template <class Vector> [[nodiscard]] std::span<const Vector> volume_gradient(int cell) const {
        if constexpr (std::is_same_v<Vector, Lanes>)
            return model.cell_nodes(volume_gradient_in_single, cell);
        else
            return model.cell_nodes(volume_gradient_um2, cell);
    }
};

}  // namespace spheroscope
