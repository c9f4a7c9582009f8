#pragma once

#include "engine/base/vec3.hpp"

#include <array>
#include <span>

namespace spheroscope {

/// Friction of one pair of triangles, eqns (17), (18): every node i of A and every node k of B
/// exchange w_ik S_AB [g_n n n^T + g_t (1 - n n^T)] (v_i - v_k). paper (17): w_ik from the nodal
/// forces, which is 0/0 or negative where the pressure vanishes; here w_ik = (lambda_i + mu_k) / 6
/// with the barycentric coordinates of the polygon's centroid: the same for uniform pressure, never
/// negative, sums to 1. So the matrix is a graph Laplacian: symmetric, positive semi-definite,
/// blind to a common translation.
struct ContactFriction {
    double normal_kPa_s_per_um;
    double tangential_kPa_s_per_um;
};

/// The graph part, for one vector per node: the weights w_ik of above without the area and the
/// friction.
struct PairGraph {
    std::array<double, 3> lambda, mu;

    /// y_a[i], y_b[k] = the graph Laplacian's product with u.
    void product(const std::array<Vec3, 3>& u_a, const std::array<Vec3, 3>& u_b,
                 std::array<Vec3, 3>& y_a, std::array<Vec3, 3>& y_b) const {
        // sum_k (lambda_i + mu_k)/6 (u_i - u_k) = u_i (3 lambda_i + 1)/6 - (lambda_i sum u + sum mu
        // u)/6
        const Vec3 sum_a = u_a[0] + u_a[1] + u_a[2];
        const Vec3 sum_b = u_b[0] + u_b[1] + u_b[2];
        const Vec3 mean_a = lambda[0] * u_a[0] + lambda[1] * u_a[1] + lambda[2] * u_a[2];
        const Vec3 mean_b = mu[0] * u_b[0] + mu[1] * u_b[1] + mu[2] * u_b[2];
        for (std::size_t i = 0; i < 3; ++i) {
            y_a[i] = ((3.0 * lambda[i] + 1.0) * u_a[i] - lambda[i] * sum_b - mean_b) / 6.0;
            y_b[i] = ((3.0 * mu[i] + 1.0) * u_b[i] - mu[i] * sum_a - mean_a) / 6.0;
        }
    }
    /// Diagonal of the graph Laplacian for node i of A (lambda_i) or of B (mu_k).
    [[nodiscard]] static double diagonal(double barycentric) {
        return (3.0 * barycentric + 1.0) / 6.0;
    }
};

}  // namespace spheroscope
