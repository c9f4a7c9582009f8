// C-14f. A thin elastic sphere under two opposite point forces gives way by delta at either pole,
// F/delta = 8 sqrt(D E t)/R (Reissner, J. Math. Phys. 25, 1946, 279), with the lattice's own
// bending rigidity D = (sqrt(3)/2) k_bend. It is a test of springs and hinges together: the dimple
// is as wide as both allow. The shell is thick (t = 2 um), so that the mesh resolves sqrt(R t).
#include "engine/forces/bending.hpp"
#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "tests/forces/test_cell.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace spheroscope::test {
namespace {

constexpr double k_E_kPa = 20.0, k_thickness_um = 2.0;

using SparseMatrix = Eigen::SparseMatrix<double>;

void add_block(std::vector<Eigen::Triplet<double>>& entries, int i, int j, const Mat3& block) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            entries.emplace_back(3 * i + row, 3 * j + column, block(row, column));
}

/// Springs and hinges at rest, where the elements are the exact second derivative of the energy
/// (StiffnessOfSprings, StiffnessOfHinges). A little on the diagonal holds the rigid motions, which
/// balanced forces do not excite.
SparseMatrix assemble(const CellStiffness& K, int n_nodes) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const CellStiffness::Edge& e : K.edges) {
        const Vec3 t = VectorTraits<Vec3>::from(e.direction);
        const Mat3 block =
            double{e.isotropic} * Mat3::Identity() + double{e.along} * t * t.transpose();
        add_block(entries, e.i, e.i, block);
        add_block(entries, e.j, e.j, block);
        add_block(entries, e.i, e.j, -block);
        add_block(entries, e.j, e.i, -block);
    }
    for (const CellStiffness::Hinge& e : K.hinges) {
        const HingeSlope slope{VectorTraits<Vec3>::from(e.by_a), VectorTraits<Vec3>::from(e.by_b),
                               double{e.foot_a}, double{e.foot_b}};
        const std::array<Vec3, 4> g = slope.gradient();
        for (std::size_t m = 0; m < 4; ++m)
            for (std::size_t n = 0; n < 4; ++n)
                add_block(entries, e.nodes[m], e.nodes[n],
                          double{e.coefficient} * g[m] * g[n].transpose());
    }
    for (int i = 0; i < n_nodes; ++i) add_block(entries, i, i, 1e-6 * Mat3::Identity());
    SparseMatrix matrix(3 * n_nodes, 3 * n_nodes);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// F/delta of a shell that is pressed at a node and at its antipode.
double stiffness_nN_per_um(const TestCell& shell, const Eigen::SimplicialLDLT<SparseMatrix>& K,
                           std::size_t pole, double* asymmetry) {
    const std::vector<Vec3>& unit = shell.model.topology->unit_shape;
    std::size_t antipode = 0;
    for (std::size_t i = 0; i < unit.size(); ++i)
        if (unit[i].dot(unit[pole]) < unit[antipode].dot(unit[pole])) antipode = i;
    const Vec3 axis = unit[pole].normalized();
    Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * unit.size()));
    force.segment<3>(static_cast<Eigen::Index>(3 * pole)) = -axis;
    force.segment<3>(static_cast<Eigen::Index>(3 * antipode)) = axis;
    const Eigen::VectorXd u = K.solve(force);
    const double at_pole = -axis.dot(u.segment<3>(static_cast<Eigen::Index>(3 * pole)));
    const double at_antipode = axis.dot(u.segment<3>(static_cast<Eigen::Index>(3 * antipode)));
    *asymmetry = std::abs(at_pole - at_antipode) / at_pole;
    return 2.0 / (at_pole + at_antipode);
}

/// Mean over poles of F/delta over Reissner's.
double over_reissner(int n_nodes) {
    const TestCell shell(n_nodes);
    const InPlaneElasticity springs({}, {.E_kPa = k_E_kPa, .thickness_um = k_thickness_um});
    const Bending hinges({}, {.E_kPa = k_E_kPa, .thickness_um = k_thickness_um});
    CellStiffness elements;
    springs.add_stiffness(shell.at(), TestCell::cell, elements);
    hinges.add_stiffness(shell.at(), TestCell::cell, elements);
    const Eigen::SimplicialLDLT<SparseMatrix> K(assemble(elements, n_nodes));
    const double k_bend = k_E_kPa * std::pow(k_thickness_um, 3) / (12.0 * (1.0 - 1.0 / 9.0));
    const double D = 0.5 * std::sqrt(3.0) * k_bend;
    const double expected = 8.0 * std::sqrt(D * k_E_kPa * k_thickness_um) / 9.0;
    EXPECT_NEAR(expected, 20.3, 0.05);
    double sum = 0.0;
    // a corner of the icosahedron, where five triangles meet, and nodes with six
    const std::vector<std::size_t> poles{0, 12, 20, 41};
    for (const std::size_t pole : poles) {
        double asymmetry = 0.0;
        const double stiffness = stiffness_nN_per_um(shell, K, pole, &asymmetry);
        std::cout << n_nodes << " nodes, pole " << pole << ": F/delta = " << stiffness
                  << " nN/um, over Reissner " << stiffness / expected << "\n";
        EXPECT_LT(asymmetry, 1e-3) << "the mesh is its own mirror image through the centre";
        sum += stiffness / expected;
    }
    return sum / static_cast<double>(poles.size());
}

TEST(ShellUnderPointForces, GivesWayAsReissnerSays) { EXPECT_NEAR(over_reissner(2562), 1.0, 0.10); }

}  // namespace
}  // namespace spheroscope::test
