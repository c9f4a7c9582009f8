#include "engine/forces/strain_limiter.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <array>
#include <utility>

namespace spheroscope {
namespace {

/// A triangle beyond the silent range. Side c is opposite to corner c and runs counter-clockwise.
struct Strained {
    std::array<int, 3> nodes;
    std::array<Vec3, 3> sides_um;
    std::array<double, 3> rest_cotangents;
    Vec3 twice_area_um2;  ///< along the normal
    double rest_area_um2;
    double I1, J;
    double excess;  ///< y = psi - psi0 > 0

    [[nodiscard]] std::array<Vec3, 3> I1_gradient() const {
        std::array<Vec3, 3> g;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t next = (c + 1) % 3, last = (c + 2) % 3;
            g[c] =
                (rest_cotangents[next] * sides_um[next] - rest_cotangents[last] * sides_um[last]) /
                rest_area_um2;
        }
        return g;
    }
    [[nodiscard]] std::array<Vec3, 3> J_gradient() const {
        const Vec3 half_normal = twice_area_um2 / (2.0 * rest_area_um2 * twice_area_um2.norm());
        return {half_normal.cross(sides_um[0]), half_normal.cross(sides_um[1]),
                half_normal.cross(sides_um[2])};
    }
    [[nodiscard]] std::array<Vec3, 3> psi_gradient() const {
        const std::array<Vec3, 3> by_I1 = I1_gradient(), by_J = J_gradient();
        const double a = 0.25 * (1.0 + 1.0 / (J * J)), b = -0.5 * I1 / (J * J * J);
        return {a * by_I1[0] + b * by_J[0], a * by_I1[1] + b * by_J[1], a * by_I1[2] + b * by_J[2]};
    }
};

/// Calls visit(Strained) for every triangle beyond the silent range.
template <class Visit> void for_each_strained(const CellView& view, double psi0, Visit visit) {
    const double R2 = view.R_um * view.R_um;
    for (std::size_t t = 0; t < view.mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = view.mesh.triangles[t];
        const Vec3 &xi = view.x(i), &xj = view.x(j), &xk = view.x(k);
        const Vec3 &ri = view.mesh.unit_shape[static_cast<std::size_t>(i)],
                   &rj = view.mesh.unit_shape[static_cast<std::size_t>(j)],
                   &rk = view.mesh.unit_shape[static_cast<std::size_t>(k)];
        Strained s;
        s.nodes = {i, j, k};
        s.sides_um = {xk - xj, xi - xk, xj - xi};
        s.twice_area_um2 = s.sides_um[1].cross(s.sides_um[2]);
        const double unit_area = view.model.unit_triangle_area[t];
        s.rest_area_um2 = R2 * unit_area;
        s.J = 0.5 * s.twice_area_um2.norm() / s.rest_area_um2;
        const std::array<Vec3, 3> rest_sides = {rk - rj, ri - rk, rj - ri};
        s.I1 = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            s.rest_cotangents[c] =
                -rest_sides[(c + 1) % 3].dot(rest_sides[(c + 2) % 3]) / (2.0 * unit_area);
            s.I1 += s.rest_cotangents[c] * s.sides_um[c].squaredNorm();
        }
        s.I1 /= 2.0 * s.rest_area_um2;
        s.excess = strain_measure(s.I1, s.J) - psi0;
        // Not `if (excess <= 0) continue`: a triangle of no area (not a number) must show up.
        if (!(s.excess <= 0.0)) visit(s);
    }
}

/// g' of g = y^2/(y + psi0).
double slope(double y, double psi0) { return y * (y + 2.0 * psi0) / ((y + psi0) * (y + psi0)); }

}  // namespace

StrainLimiter::StrainLimiter(Loc loc, const StrainLimiterParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_not_negative(this->loc(), "cortex.regularisation.kappa", parameters_.kappa_nN_per_um,
                      "nN/um");
    want_positive(this->loc(), "cortex.regularisation.psi0", parameters_.psi0, "");
}

void StrainLimiter::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    for_each_strained(CellView(at, cell), parameters_.psi0, [&](const Strained& s) {
        const double strength =
            parameters_.kappa_nN_per_um * s.rest_area_um2 * slope(s.excess, parameters_.psi0);
        const std::array<Vec3, 3> g = s.psi_gradient();
        for (std::size_t c = 0; c < 3; ++c) at_node(F_nN, s.nodes[c]) -= strength * g[c];
    });
}

std::optional<double> StrainLimiter::energy_fJ(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_strained(CellView(at, cell), parameters_.psi0, [&](const Strained& s) {
        sum += parameters_.kappa_nN_per_um * s.rest_area_um2 * s.excess * s.excess /
               (s.excess + parameters_.psi0);
    });
    return sum;
}

void StrainLimiter::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    const double kappa = parameters_.kappa_nN_per_um, psi0 = parameters_.psi0;
    for_each_strained(CellView(at, cell), psi0, [&](const Strained& s) {
        const double first = slope(s.excess, psi0);
        const double y = s.excess + psi0;
        const double second = 2.0 * psi0 * psi0 / (y * y * y);
        K.triangles.emplace_back(s.nodes, s.psi_gradient(), kappa * s.rest_area_um2 * second);
        const double J2 = s.J * s.J;
        K.triangles.emplace_back(s.nodes, s.J_gradient(),
                                 1.5 * kappa * s.rest_area_um2 * first * s.I1 / (J2 * J2));
        const double pull = 0.25 * kappa * first * (1.0 + 1.0 / J2);
        for (std::size_t c = 0; c < 3; ++c)
            if (s.rest_cotangents[c] > 0.0)
                K.edges.emplace_back(s.nodes[(c + 1) % 3], s.nodes[(c + 2) % 3],
                                     pull * s.rest_cotangents[c], 0.0, Vec3::Zero());
    });
}

}  // namespace spheroscope
