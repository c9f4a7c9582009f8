#include "tests/reference/dense_system.hpp"

#include <stdexcept>

namespace spheroscope::reference {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// An empty matrix of the size of all nodes, addressed by blocks of node pairs.
class Blocks {
  public:
    explicit Blocks(const Model& model)
        : nodes_per_cell_(model.n_nodes()),
          matrix_(MatrixXd::Zero(static_cast<Index>(3 * model.n_all_nodes()),
                                 static_cast<Index>(3 * model.n_all_nodes()))) {}
    [[nodiscard]] int node(int cell, int local) const { return cell * nodes_per_cell_ + local; }
    void add(int i, int j, const Mat3& block) { matrix_.block<3, 3>(3 * i, 3 * j) += block; }
    /// block on the difference u_i - u_j, with its reaction.
    void add_between(int i, int j, const Mat3& block) {
        add(i, i, block);
        add(j, j, block);
        add(i, j, -block);
        add(j, i, -block);
    }
    /// coefficient g g^T for g over some nodes.
    void add_square(std::span<const int> nodes, std::span<const Vec3> gradient,
                    double coefficient) {
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < nodes.size(); ++j)
                add(nodes[i], nodes[j], coefficient * gradient[i] * gradient[j].transpose());
    }
    [[nodiscard]] MatrixXd take() { return std::move(matrix_); }

  private:
    int nodes_per_cell_;
    MatrixXd matrix_;
};

}  // namespace

MatrixXd dense_drag(const Model& model, double eta_f_kPa_s) {
    Blocks blocks(model);
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const double R = model.radius_um[static_cast<std::size_t>(cell)];
        for (const auto& triangle : model.topology->triangles) {
            const auto at = [&](std::size_t i) -> const Vec3& {
                return model.topology->unit_shape[static_cast<std::size_t>(triangle[i])];
            };
            const double area_um2 = 0.5 * R * R * (at(1) - at(0)).cross(at(2) - at(0)).norm();
            for (const int local : triangle) {
                const int i = blocks.node(cell, local);
                blocks.add(i, i, 3.0 * eta_f_kPa_s / (2.0 * R) * area_um2 / 3.0 * Mat3::Identity());
            }
        }
    }
    return blocks.take();
}

MatrixXd dense_cortex(const Model& model, double edge_nN_s_per_um) {
    Blocks blocks(model);
    for (int cell = 0; cell < model.n_cells(); ++cell)
        for (const MeshTopology::Edge& e : model.topology->edges)
            blocks.add_between(blocks.node(cell, e.i), blocks.node(cell, e.j),
                               edge_nN_s_per_um * Mat3::Identity());
    return blocks.take();
}

MatrixXd dense_contact_friction(const Model& model, const Contacts& contacts,
                                const ContactFriction& friction) {
    Blocks blocks(model);
    for (const Contacts::Group& group : contacts.groups)
        for (const ContactPair& pair : contacts.pairs_of(group)) {
            const auto& nodes_a =
                model.topology->triangles[static_cast<std::size_t>(pair.triangle_a)];
            const auto& nodes_b =
                model.topology->triangles[static_cast<std::size_t>(pair.triangle_b)];
            const Mat3 nn = pair.normal * pair.normal.transpose();
            const Mat3 friction_of_pair =
                pair.area_um2 * (friction.normal_kPa_s_per_um * nn +
                                 friction.tangential_kPa_s_per_um * (Mat3::Identity() - nn));
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const double weight = (pair.lambda[i] + pair.mu[k]) / 6.0;
                    blocks.add_between(blocks.node(group.cell_a, nodes_a[i]),
                                       blocks.node(group.cell_b, nodes_b[k]),
                                       weight * friction_of_pair);
                }
        }
    return blocks.take();
}

MatrixXd dense_contact_stiffness(const Model& model, const Contacts& contacts,
                                 double k_kPa_per_um) {
    Blocks blocks(model);
    for (const Contacts::Group& group : contacts.groups)
        for (const ContactPair& pair : contacts.pairs_of(group)) {
            const auto& nodes_a =
                model.topology->triangles[static_cast<std::size_t>(pair.triangle_a)];
            const auto& nodes_b =
                model.topology->triangles[static_cast<std::size_t>(pair.triangle_b)];
            std::array<int, 6> nodes{};
            std::array<Vec3, 6> gradient;
            for (std::size_t i = 0; i < 3; ++i) {
                nodes[i] = blocks.node(group.cell_a, nodes_a[i]);
                gradient[i] = pair.lambda[i] * pair.normal;
                nodes[3 + i] = blocks.node(group.cell_b, nodes_b[i]);
                gradient[3 + i] = -pair.mu[i] * pair.normal;
            }
            blocks.add_square(nodes, gradient, k_kPa_per_um * pair.area_um2);
        }
    return blocks.take();
}

MatrixXd dense_cell_stiffness(const Model& model, std::span<const CellStiffness> stiffness) {
    Blocks blocks(model);
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const CellStiffness& K = stiffness[static_cast<std::size_t>(cell)];
        const auto node = [&](int local) { return blocks.node(cell, local); };
        const auto vec3 = [](const std::array<float, 3>& v) { return VectorTraits<Vec3>::from(v); };
        for (const CellStiffness::Edge& e : K.edges)
            blocks.add_between(node(e.i), node(e.j),
                               double{e.isotropic} * Mat3::Identity() +
                                   double{e.along} * vec3(e.direction) *
                                       vec3(e.direction).transpose());
        for (const CellStiffness::Normal& e : K.normals) {
            const std::array nodes{node(e.nodes[0]), node(e.nodes[1]), node(e.nodes[2])};
            const double p = double{e.p}, q = double{e.q}, r = double{e.r};
            const Vec3 n = vec3(e.normal);
            blocks.add_square(nodes, std::array<Vec3, 3>{p * n, q * n, -(p + q) * n}, 1.0);
            blocks.add_square(nodes, std::array<Vec3, 3>{Vec3::Zero(), r * n, -r * n}, 1.0);
        }
        for (const CellStiffness::Triangle& e : K.triangles)
            blocks.add_square(
                std::array{node(e.nodes[0]), node(e.nodes[1]), node(e.nodes[2])},
                std::array{vec3(e.gradient[0]), vec3(e.gradient[1]), vec3(e.gradient[2])},
                double{e.coefficient});
        for (const CellStiffness::Hinge& e : K.hinges)
            blocks.add_square(
                std::array{node(e.nodes[0]), node(e.nodes[1]), node(e.nodes[2]), node(e.nodes[3])},
                HingeSlope{vec3(e.by_a), vec3(e.by_b), double{e.foot_a}, double{e.foot_b}}
                    .gradient(),
                double{e.coefficient});
        for (const CellStiffness::Node& e : K.nodes)
            blocks.add(node(e.node), node(e.node),
                       double{e.coefficient} * vec3(e.direction) * vec3(e.direction).transpose());
    }
    return blocks.take();
}

MatrixXd dense_volume(const Model& model, std::span<const double> coefficient,
                      std::span<const Vec3> volume_gradient) {
    if (coefficient.size() != model.radius_um.size())
        throw std::invalid_argument("the volume part wants one coefficient per cell");
    Blocks blocks(model);
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        std::vector<int> nodes;
        for (int local = 0; local < model.n_nodes(); ++local)
            nodes.push_back(blocks.node(cell, local));
        blocks.add_square(nodes, model.cell_nodes(volume_gradient, cell),
                          coefficient[static_cast<std::size_t>(cell)]);
    }
    return blocks.take();
}

MatrixXd dense_product(const VelocitySystem& system, Workers& workers) {
    const std::size_t n = system.model.n_all_nodes();
    MatrixXd matrix(static_cast<Index>(3 * n), static_cast<Index>(3 * n));
    std::vector<Vec3> u(n), out(n);
    for (std::size_t column = 0; column < 3 * n; ++column) {
        std::fill(u.begin(), u.end(), Vec3::Zero());
        u[column / 3][static_cast<Index>(column % 3)] = 1.0;
        system.product(u, out, workers);
        matrix.col(static_cast<Index>(column)) = flat(out);
    }
    return matrix;
}

double largest(const MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

Eigen::VectorXd flat(std::span<const Vec3> vectors) {
    Eigen::VectorXd values(static_cast<Index>(3 * vectors.size()));
    for (std::size_t i = 0; i < vectors.size(); ++i)
        values.segment<3>(static_cast<Index>(3 * i)) = vectors[i];
    return values;
}

std::vector<Vec3> unflat(const Eigen::VectorXd& values) {
    std::vector<Vec3> vectors;
    for (Index i = 0; i < values.size(); i += 3) vectors.emplace_back(values.segment<3>(i));
    return vectors;
}

}  // namespace spheroscope::reference
