#include "engine/forces/bending.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/model/model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

// What springs and hinges amount to on a regular triangular sheet, where the continuum is known
// exactly.
namespace spheroscope {
namespace {

constexpr double k_E_kPa = 20.0, k_t_um = 0.2, k_Et = k_E_kPa * k_t_um;
constexpr double k_strain = 1e-3;
constexpr double k_tolerance = 1e-3;  // springs are linear in engineering strain: error ~ strain

/// An open patch of equilateral triangles; an edge at the rim has the spring of its one triangle.
struct Sheet {
    struct Spring {
        int i, j;
        double k_nN_per_um;
    };
    double d_um = 1.3;
    std::vector<Vec3> x_um;
    std::vector<Spring> springs;
    double area_um2 = 0.0;

    explicit Sheet(int n) {
        const double height = std::sqrt(3.0) / 2.0 * d_um;
        const double S = 0.5 * d_um * height;
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column)
                x_um.emplace_back(d_um * (column + 0.5 * row), height * row, 0.0);
        const auto node = [&](int row, int column) { return row * n + column; };
        const auto inside = [&](int row, int column) {
            return row >= 0 && row < n - 1 && column >= 0 && column < n - 1;
        };
        // The parallelogram (row, column) is cut by its short diagonal into two triangles.
        const auto spring = [&](int i, int j, int n_triangles) {
            const double S_other = n_triangles == 2 ? S : 0.0;
            springs.push_back({i, j, k_spring_nN_per_um(k_E_kPa, k_t_um, S, S_other, d_um)});
        };
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column) {
                if (column + 1 < n)
                    spring(node(row, column), node(row, column + 1),
                           inside(row, column) + inside(row - 1, column));
                if (row + 1 < n)
                    spring(node(row, column), node(row + 1, column),
                           inside(row, column) + inside(row, column - 1));
                if (inside(row, column)) {
                    spring(node(row, column + 1), node(row + 1, column), 2);
                    area_um2 += 2.0 * S;
                }
            }
    }

    /// Energy when every point x moves to map(x), fJ.
    [[nodiscard]] double energy_fJ(const Mat3& map) const {
        double sum = 0.0;
        for (const Spring& s : springs)
            sum += spring_energy_fJ(s.k_nN_per_um, d_um, map * at(s.i), map * at(s.j));
        return sum;
    }
    [[nodiscard]] const Vec3& at(int i) const { return x_um[static_cast<std::size_t>(i)]; }
};

Mat3 in_plane(double xx, double yy, double xy) {
    Mat3 map = Mat3::Identity();
    map(0, 0) += xx;
    map(1, 1) += yy;
    map(0, 1) = map(1, 0) = xy;
    return map;
}

/// Where f has its minimum between low and high (golden section).
double minimum(const std::function<double(double)>& f, double low, double high) {
    const double ratio = 1.0 / std::numbers::phi;
    double a = high - ratio * (high - low), b = low + ratio * (high - low);
    double fa = f(a), fb = f(b);
    for (int n = 0; n < 60; ++n) {
        if (fa < fb) {
            high = b, b = a, fb = fa;
            a = high - ratio * (high - low), fa = f(a);
        } else {
            low = a, a = b, fa = fb;
            b = low + ratio * (high - low), fb = f(b);
        }
    }
    return 0.5 * (low + high);
}

// C-4. With the width free the energy per area is Y/2 times the strain squared.
TEST(RegularSheet, HasYoungsModulusEtAndPoissonRatioOneThird) {
    const Sheet sheet(12);
    for (const bool along_an_edge : {true, false}) {
        const auto stretched = [&](double length, double width) {
            return sheet.energy_fJ(along_an_edge ? in_plane(length, width, 0.0)
                                                 : in_plane(width, length, 0.0));
        };
        const double width = minimum([&](double w) { return stretched(k_strain, w); },
                                     -3.0 * k_strain, 3.0 * k_strain);
        EXPECT_NEAR(-width / k_strain, 1.0 / 3.0, k_tolerance / 3.0);
        const double Y = 2.0 * stretched(k_strain, width) / (sheet.area_um2 * k_strain * k_strain);
        EXPECT_NEAR(Y, 4.000, 4.0 * k_tolerance);
    }
}

TEST(RegularSheet, HasAreaModulusThreeQuartersEt) {
    const Sheet sheet(12);
    const double U = sheet.energy_fJ(in_plane(k_strain, k_strain, 0.0));
    EXPECT_NEAR(U / (2.0 * k_strain * k_strain * sheet.area_um2), 0.75 * k_Et, k_Et * k_tolerance);
}

TEST(RegularSheet, HasShearModulusThreeEighthsEt) {
    const Sheet sheet(12);
    for (const Mat3& shear : {in_plane(0.0, 0.0, k_strain), in_plane(k_strain, -k_strain, 0.0)})
        EXPECT_NEAR(sheet.energy_fJ(shear) / (2.0 * k_strain * k_strain * sheet.area_um2),
                    0.375 * k_Et, 0.375 * k_Et * k_tolerance);
}

// The moduli above rest on the sheet deforming evenly: then no inner node may feel a force.
TEST(RegularSheet, EvenDeformationIsInEquilibrium) {
    const int n = 6;
    const Sheet sheet(n);
    const Mat3 map = in_plane(0.02, -0.01, 0.015);
    std::vector<Vec3> F(sheet.x_um.size(), Vec3::Zero());
    double largest = 0.0;
    for (const Sheet::Spring& s : sheet.springs) {
        const Vec3 f =
            spring_force_nN(s.k_nN_per_um, sheet.d_um, map * sheet.at(s.i), map * sheet.at(s.j));
        F[static_cast<std::size_t>(s.i)] += f;
        F[static_cast<std::size_t>(s.j)] -= f;
        largest = std::max(largest, f.norm());
    }
    for (int row = 1; row < n - 1; ++row)
        for (int column = 1; column < n - 1; ++column)
            // rounding of coordinates of 10 um over stretches of 1 % of 1 um
            EXPECT_LT(F[static_cast<std::size_t>(row * n + column)].norm(), 1e-12 * largest);
}

// C-5: the three hinges of one node fill an area of sqrt(3)/2 d^2 (Seung and Nelson 1988). The
// lattice may lie on the cylinder in any direction.
TEST(RegularSheet, RolledToACylinderHasTheBendingEnergyOfTheLattice) {
    const double k_fJ = 0.015, d_um = 1.0, rho_um = 10.0;
    for (const double direction : {0.0, 0.2, std::numbers::pi / 6.0}) {
        const auto rolled = [&](double u, double v) {  // lattice coordinates -> cylinder about y
            const double x = d_um * (u + 0.5 * v), y = d_um * std::sqrt(3.0) / 2.0 * v;
            const double s = std::cos(direction) * x - std::sin(direction) * y;
            const double z = std::sin(direction) * x + std::cos(direction) * y;
            return Vec3(rho_um * std::sin(s / rho_um), z, rho_um * std::cos(s / rho_um));
        };
        const Vec3 o = rolled(0, 0), right = rolled(1, 0), up = rolled(0, 1), left = rolled(-1, 1),
                   down = rolled(1, -1);
        const double U = hinge_energy_fJ(k_fJ, hinge_angle(o, right, up, down), 0.0) +
                         hinge_energy_fJ(k_fJ, hinge_angle(o, up, left, right), 0.0) +
                         hinge_energy_fJ(k_fJ, hinge_angle(o, left, rolled(-1, 0), up), 0.0);
        const double area_um2 = std::sqrt(3.0) / 2.0 * d_um * d_um;
        const double expected = 0.5 * (std::sqrt(3.0) / 2.0) * k_fJ / (rho_um * rho_um);
        EXPECT_NEAR(U / area_um2, expected, 0.02 * expected) << direction;
    }
}

}  // namespace
}  // namespace spheroscope
