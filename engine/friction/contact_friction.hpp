#pragma once

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

}  // namespace spheroscope
