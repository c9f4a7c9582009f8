// Springs with the constants of eqn (8) make a sheet of modulus E t exactly on a regular lattice
// only (regular_sheet_test.cpp; Van Gelder 1998). Here: on triangles as uneven as those of the
// cells' icospheres.
#include "engine/base/random.hpp"
#include "engine/forces/in_plane_elasticity.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace spheroscope {
namespace {

constexpr double k_E_kPa = 20.0, k_t_um = 0.2, k_Et = k_E_kPa * k_t_um;

/// An open patch of n x n nodes, each but those of the rim shaken in the plane.
class ShakenSheet {
  public:
    static constexpr double k_d_um = 1.3;

    ShakenSheet(int n, double noise, std::uint64_t seed) {
        const Random random(seed, 0);
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column) {
                const bool is_inside = row > 0 && column > 0 && row < n - 1 && column < n - 1;
                const auto i = static_cast<std::uint64_t>(row * n + column);
                const double size = is_inside ? noise * k_d_um : 0.0;
                x_um_.emplace_back(k_d_um * (column + 0.5 * row) + size * random.normal(i, 0),
                                   k_d_um * std::sqrt(0.75) * row + size * random.normal(i, 1),
                                   0.0);
                unknown_.push_back(is_inside ? n_unknowns_++ : -1);
            }
        for (int row = 0; row + 1 < n; ++row)
            for (int column = 0; column + 1 < n; ++column) {
                const int here = row * n + column;
                add_triangle(here, here + 1, here + n);
                add_triangle(here + 1, here + n + 1, here + n);
            }
        for (auto& [nodes, spring] : springs_) {
            spring.d_um = (at(nodes.second) - at(nodes.first)).norm();
            spring.k_nN_per_um = k_spring_nN_per_um(k_E_kPa, k_t_um, spring.areas_um2[0],
                                                    spring.areas_um2[1], spring.d_um);
        }
    }

    /// Standard deviation of the edges' lengths over their mean.
    [[nodiscard]] double edge_spread() const {
        double sum = 0.0, sum2 = 0.0;
        for (const auto& [nodes, spring] : springs_) {
            sum += spring.d_um;
            sum2 += spring.d_um * spring.d_um;
        }
        const double mean = sum / static_cast<double>(springs_.size());
        return std::sqrt(sum2 / static_cast<double>(springs_.size()) - mean * mean) / mean;
    }

    /// Second derivative of the energy per area by (xx, yy, 2 xy), nN/um: the rim moves as the
    /// strain says, the nodes inside go where no force is left.
    [[nodiscard]] Eigen::Matrix3d stiffness_nN_per_um() const {
        constexpr double strain = 1e-4;
        const std::array<Mat3, 3> unit{in_plane(1.0, 0.0, 0.0), in_plane(0.0, 1.0, 0.0),
                                       in_plane(0.0, 0.0, 0.5)};
        const auto energy_fJ = [&](const Mat3& direction) {
            return energy_of_fJ(relaxed(strain * direction)) +
                   energy_of_fJ(relaxed(-strain * direction));  // odd terms cancel
        };
        Eigen::Matrix3d C;
        for (int a = 0; a < 3; ++a) C(a, a) = energy_fJ(unit[std::size_t(a)]);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < a; ++b)
                C(a, b) = C(b, a) = 0.5 * (energy_fJ(unit[std::size_t(a)] + unit[std::size_t(b)]) -
                                           C(a, a) - C(b, b));
        return C / (strain * strain * area_um2_);
    }

  private:
    struct Spring {
        std::array<double, 2> areas_um2{0.0, 0.0};
        int n_triangles = 0;
        double d_um = 0.0, k_nN_per_um = 0.0;
    };

    static Mat3 in_plane(double xx, double yy, double xy) {
        Mat3 strain = Mat3::Zero();
        strain(0, 0) = xx;
        strain(1, 1) = yy;
        strain(0, 1) = strain(1, 0) = xy;
        return strain;
    }
    [[nodiscard]] const Vec3& at(int i) const { return x_um_[static_cast<std::size_t>(i)]; }

    void add_triangle(int i, int j, int k) {
        const double S_um2 = 0.5 * (at(j) - at(i)).cross(at(k) - at(i)).norm();
        area_um2_ += S_um2;
        for (const auto& [a, b] : {std::pair(i, j), std::pair(j, k), std::pair(k, i)}) {
            Spring& spring = springs_[std::minmax(a, b)];
            spring.areas_um2.at(static_cast<std::size_t>(spring.n_triangles++)) = S_um2;
        }
    }

    /// Positions under a strain, from the springs' stiffness at rest.
    [[nodiscard]] std::vector<Vec3> relaxed(const Mat3& strain) const {
        std::vector<Vec3> x_um;
        for (const Vec3& x : x_um_) x_um.push_back(x + strain * x);
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * n_unknowns_);
        for (const auto& [nodes, spring] : springs_) {
            const int a = unknown_[static_cast<std::size_t>(nodes.first)],
                      b = unknown_[static_cast<std::size_t>(nodes.second)];
            const Vec3 t = (at(nodes.second) - at(nodes.first)) / spring.d_um;
            const Eigen::Matrix2d block =
                spring.k_nN_per_um * t.head<2>() * t.head<2>().transpose();
            const Eigen::Vector2d pull =
                block * (strain * (at(nodes.second) - at(nodes.first))).head<2>();
            if (a >= 0) force.segment<2>(2 * a) += pull;
            if (b >= 0) force.segment<2>(2 * b) -= pull;
            for (const auto& [row, column, sign] : {std::tuple(a, a, 1.0), std::tuple(b, b, 1.0),
                                                    std::tuple(a, b, -1.0), std::tuple(b, a, -1.0)})
                if (row >= 0 && column >= 0)
                    for (int r = 0; r < 2; ++r)
                        for (int c = 0; c < 2; ++c)
                            entries.emplace_back(2 * row + r, 2 * column + c, sign * block(r, c));
        }
        Eigen::SparseMatrix<double> K(2 * n_unknowns_, 2 * n_unknowns_);
        K.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(K);
        const Eigen::VectorXd u = factor.solve(force);
        for (std::size_t i = 0; i < x_um.size(); ++i)
            if (unknown_[i] >= 0) x_um[i].head<2>() += u.segment<2>(2 * unknown_[i]);
        return x_um;
    }

    [[nodiscard]] double energy_of_fJ(const std::vector<Vec3>& x_um) const {
        double sum = 0.0;
        for (const auto& [nodes, spring] : springs_)
            sum += spring_energy_fJ(spring.k_nN_per_um, spring.d_um,
                                    x_um[static_cast<std::size_t>(nodes.first)],
                                    x_um[static_cast<std::size_t>(nodes.second)]);
        return sum;
    }

    std::vector<Vec3> x_um_;
    std::vector<int> unknown_;  // -1: on the rim
    int n_unknowns_ = 0;
    std::map<std::pair<int, int>, Spring> springs_;
    double area_um2_ = 0.0;
};

struct Moduli {
    double Young, Poisson, area, shear;  // nN/um but the second
};

Moduli moduli_of(const Eigen::Matrix3d& C) {
    const Eigen::Matrix3d S = C.inverse();
    return {2.0 / (S(0, 0) + S(1, 1)), -2.0 * S(0, 1) / (S(0, 0) + S(1, 1)),
            0.25 * (C(0, 0) + C(1, 1) + 2.0 * C(0, 1)), C(2, 2)};
}

// C-4 on uneven triangles: 3 %.
TEST(ShakenSheet, HasTheModuliOfTheRegularOneWithinThreePercent) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const ShakenSheet sheet(20, 0.07, seed);
        EXPECT_NEAR(sheet.edge_spread(), 0.09, 0.01) << "as the icospheres' edges";
        const Moduli moduli = moduli_of(sheet.stiffness_nN_per_um());
        std::cout << "seed " << seed << ": Y " << moduli.Young / k_Et << " E t, nu "
                  << moduli.Poisson << ", K_A " << moduli.area / k_Et << ", G "
                  << moduli.shear / k_Et << "\n";
        EXPECT_NEAR(moduli.Young / k_Et, 1.0, 0.03);
        EXPECT_NEAR(moduli.Poisson, 1.0 / 3.0, 0.01);
        EXPECT_NEAR(moduli.area / k_Et, 0.75, 0.03 * 0.75);
        EXPECT_NEAR(moduli.shear / k_Et, 0.375, 0.03 * 0.375);
    }
}

TEST(ShakenSheet, WithoutShakingIsTheRegularOne) {
    const Moduli moduli = moduli_of(ShakenSheet(16, 0.0, 1).stiffness_nN_per_um());
    EXPECT_NEAR(moduli.Young / k_Et, 1.0, 1e-3);
    EXPECT_NEAR(moduli.shear / k_Et, 0.375, 1e-3);
}

}  // namespace
}  // namespace spheroscope
