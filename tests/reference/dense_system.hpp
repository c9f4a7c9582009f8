#pragma once

#include "engine/solve/friction_matrix.hpp"
#include "engine/solve/velocity_system.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace spheroscope::reference {

// The matrices of the equation of motion as dense ones [3 n_all_nodes squared], assembled entry by
// entry from their definitions. Row 3 i + k is component k of node i.

/// Drag of the medium, eqn (14), from the rest areas of the triangles.
[[nodiscard]] Eigen::MatrixXd dense_drag(const Model& model, double eta_f_kPa_s);
/// Cortex viscosity, eqns (15) and (16).
[[nodiscard]] Eigen::MatrixXd dense_cortex(const Model& model, double edge_nN_s_per_um);
/// Contact friction, eqns (17) and (18), pair of nodes by pair of nodes.
[[nodiscard]] Eigen::MatrixXd dense_contact_friction(const Model& model, const Contacts& contacts,
                                                     const ContactFriction& friction);
/// Normal stiffness of the contacts: k S n n^T on the relative displacement at each centroid.
[[nodiscard]] Eigen::MatrixXd dense_contact_stiffness(const Model& model, const Contacts& contacts,
                                                      double k_kPa_per_um);
/// The cells' own stiffness, from the lists of elements.
[[nodiscard]] Eigen::MatrixXd dense_cell_stiffness(const Model& model,
                                                   std::span<const CellStiffness> stiffness);
/// coefficient S S^T per cell.
[[nodiscard]] Eigen::MatrixXd dense_volume(const Model& model, std::span<const double> coefficient,
                                           std::span<const Vec3> volume_gradient);

/// The matrix behind a product, column by column.
[[nodiscard]] Eigen::MatrixXd dense_product(const VelocitySystem& system, Workers& workers);

/// Largest absolute entry.
[[nodiscard]] double largest(const Eigen::MatrixXd& matrix);

[[nodiscard]] Eigen::VectorXd flat(std::span<const Vec3> vectors);
[[nodiscard]] std::vector<Vec3> unflat(const Eigen::VectorXd& values);

}  // namespace spheroscope::reference
