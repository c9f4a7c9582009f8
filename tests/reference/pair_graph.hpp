#pragma once

#include "engine/base/vec3.hpp"

#include <array>

namespace spheroscope::reference {

/// The graph of a pair's friction (engine/friction/contact_friction.hpp), for one vector per node:
/// the weights w_ik without the area and the friction.
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

}  // namespace spheroscope::reference
