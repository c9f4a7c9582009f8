// A flat sheet of springs and dashpots under a constant line tension: the engine holds closed
// meshes only, so the sheet is put together here from the same laws of one edge.
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/friction/cortex_viscosity.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace spheroscope::test {
namespace {

constexpr double k_E_kPa = 20.0, k_t_um = 0.2, k_eta_kPa_s = 1.0;

TEST(Edge, CreepsExponentiallyUnderAConstantPull) {
    // k (d - d*) + c d' = f: the strain rises as 1 - exp(-k t/c) with c/k = 2 eta/3E in a regular
    // sheet.
    const double d_um = 1.4, S_um2 = std::sqrt(3.0) / 4.0 * d_um * d_um, pull_nN = 0.02;
    const double k = k_spring_nN_per_um(k_E_kPa, k_t_um, S_um2, S_um2, d_um);
    const double c = edge_friction_nN_s_per_um(k_eta_kPa_s, k_t_um);
    EXPECT_NEAR(c / k, 2.0 * k_eta_kPa_s / (3.0 * k_E_kPa), 1e-12);
    Vec3 i(0.0, 0.0, 0.0), j(d_um, 0.0, 0.0);
    const double dt_s = 2e-6;
    double t_s = 0.0;
    for (const double until_s : {0.01, 0.0333, 0.1}) {
        while (t_s < until_s - 0.5 * dt_s) {
            // The dashpot carries what the spring does not: c (v_j - v_i) = f - k (d - d*).
            const Vec3 relative = (Vec3(pull_nN, 0.0, 0.0) - spring_force_nN(k, d_um, i, j)) / c;
            i -= 0.5 * dt_s * relative;
            j += 0.5 * dt_s * relative;
            t_s += dt_s;
        }
        const double strain = (j - i).norm() / d_um - 1.0;
        const double expected = pull_nN / (k * d_um) * (1.0 - std::exp(-k * t_s / c));
        EXPECT_NEAR(strain / expected, 1.0, 1e-4) << "at " << t_s << " s";
    }
}

/// A parallelogram of equilateral triangles in the plane z = 0. At its rim an edge has one
/// triangle, and with it half of an inner edge's spring and half of its dashpot.
class Sheet {
  public:
    explicit Sheet(int n) {
        for (int row = 0; row <= n; ++row)
            for (int column = 0; column <= n; ++column)
                rest_.emplace_back(k_d_um * (column + 0.5 * row), k_d_um * std::sqrt(0.75) * row,
                                   0.0);
        const auto node = [n](int column, int row) {
            return static_cast<std::size_t>(row * (n + 1) + column);
        };
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column) {
                triangles_.push_back(
                    {node(column, row), node(column + 1, row), node(column, row + 1)});
                triangles_.push_back(
                    {node(column + 1, row), node(column + 1, row + 1), node(column, row + 1)});
            }
        for (const auto& triangle : triangles_)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto ends = std::minmax(triangle[k], triangle[(k + 1) % 3]);
                ++n_triangles_of_edge_[{ends.first, ends.second}];
            }
        const auto size = static_cast<Eigen::Index>(rest_.size());
        // A drag far too small to matter fixes the sheet in the plane.
        Eigen::MatrixXd gamma = 1e-9 * Eigen::MatrixXd::Identity(size, size);
        const double c = edge_friction_nN_s_per_um(k_eta_kPa_s, k_t_um);
        for (const auto& [edge, n_triangles] : n_triangles_of_edge_) {
            const auto i = static_cast<Eigen::Index>(edge.first);
            const auto j = static_cast<Eigen::Index>(edge.second);
            const double share = 0.5 * c * n_triangles;
            gamma(i, i) += share;
            gamma(j, j) += share;
            gamma(i, j) -= share;
            gamma(j, i) -= share;
        }
        friction_.compute(gamma);
        x_ = rest_;
    }

    /// Explicit steps under a line tension along x, nN/um, that acts on the rim.
    void creep(double line_tension, double dt_s, int n_steps) {
        const double S_um2 = std::sqrt(3.0) / 4.0 * k_d_um * k_d_um;
        for (int step = 0; step < n_steps; ++step) {
            std::vector<Vec3> F(x_.size(), Vec3::Zero());
            for (const auto& [edge, n_triangles] : n_triangles_of_edge_) {
                const double k = k_spring_nN_per_um(k_E_kPa, k_t_um, S_um2,
                                                    n_triangles == 2 ? S_um2 : 0.0, k_d_um);
                const Vec3 f = spring_force_nN(k, k_d_um, x_[edge.first], x_[edge.second]);
                F[edge.first] += f;
                F[edge.second] -= f;
            }
            // Nodal forces of a uniform tension in every triangle; inside the sheet they cancel, so
            // what is left is the load on the rim. Half a side, turned by 90 degrees, for each
            // corner.
            for (const auto& triangle : triangles_)
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3 opposite =
                        rest_[triangle[(k + 2) % 3]] - rest_[triangle[(k + 1) % 3]];
                    F[triangle[k]].x() += line_tension * 0.5 * -opposite.y();
                }
            Eigen::MatrixXd right(static_cast<Eigen::Index>(x_.size()), 3);
            for (std::size_t i = 0; i < x_.size(); ++i)
                right.row(static_cast<Eigen::Index>(i)) = F[i].transpose();
            const Eigen::MatrixXd v = friction_.solve(right);
            for (std::size_t i = 0; i < x_.size(); ++i)
                x_[i] += dt_s * Vec3(v.row(static_cast<Eigen::Index>(i)).transpose());
        }
    }
    /// Strain of the triangle in the middle of the sheet along x and y.
    [[nodiscard]] std::array<double, 2> strain() const {
        const auto& triangle = triangles_[triangles_.size() / 2];
        const auto sides = [&](const std::vector<Vec3>& x) {
            Eigen::Matrix2d m;
            m << (x[triangle[1]] - x[triangle[0]]).head<2>(),
                (x[triangle[2]] - x[triangle[0]]).head<2>();
            return m;
        };
        const Eigen::Matrix2d gradient = sides(x_) * sides(rest_).inverse();
        return {gradient(0, 0) - 1.0, gradient(1, 1) - 1.0};
    }

  private:
    static constexpr double k_d_um = 1.4;
    std::vector<Vec3> rest_, x_;
    std::vector<std::array<std::size_t, 3>> triangles_;
    std::map<std::pair<std::size_t, std::size_t>, int> n_triangles_of_edge_;
    Eigen::LLT<Eigen::MatrixXd> friction_;
};

TEST(Sheet, CreepsWithTheTwoTimesOfStretchAndShear) {
    const double tau1_s = 2.0 * k_eta_kPa_s / (3.0 * k_E_kPa), tau2_s = 2.0 * tau1_s;
    const double line_tension = 1e-3 * k_E_kPa * k_t_um;  // a final strain of a thousandth
    const double final_strain = line_tension / (k_E_kPa * k_t_um);
    constexpr double dt_s = 1e-4;
    Sheet sheet(4);
    double t_s = 0.0;
    const std::vector<std::pair<double, double>> table{
        {0.020, 0.323}, {0.0333, 0.473}, {0.0667, 0.710}, {0.100, 0.835}, {0.200, 0.966}};
    for (const auto& [at_s, printed] : table) {
        const int n_steps = static_cast<int>(std::lround((at_s - t_s) / dt_s));
        sheet.creep(line_tension, dt_s, n_steps);
        t_s += n_steps * dt_s;
        const double closed_form =
            (1.0 - std::exp(-t_s / tau1_s)) / 3.0 + 2.0 * (1.0 - std::exp(-t_s / tau2_s)) / 3.0;
        EXPECT_NEAR(closed_form, printed, 1e-3);
        const auto [along, across] = sheet.strain();
        EXPECT_NEAR(along / final_strain, closed_form, 0.01 * closed_form) << "at " << t_s << " s";
        EXPECT_LT(across, 0.0);
    }
    sheet.creep(line_tension, dt_s, 6000);
    const auto [along, across] = sheet.strain();
    EXPECT_NEAR(along / final_strain, 1.0, 0.005) << "Young's modulus E t";
    EXPECT_NEAR(-across / along, 1.0 / 3.0, 0.005) << "Poisson's ratio";
}

}  // namespace
}  // namespace spheroscope::test
