#include "tests/claims/doublet_shape.hpp"

#include "engine/base/error.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace spheroscope::test {
namespace {

constexpr double k_cap_share = 0.55;

std::vector<Vec3> nodes_of_cell(const Snapshot& snapshot, std::size_t cell) {
    const auto n = static_cast<std::size_t>(snapshot.header->topology->n_nodes());
    std::vector<Vec3> nodes;
    for (std::size_t i = cell * n; i < (cell + 1) * n; ++i)
        nodes.emplace_back(double{snapshot.x_um[3 * i]}, double{snapshot.x_um[3 * i + 1]},
                           double{snapshot.x_um[3 * i + 2]});
    return nodes;
}

Vec3 mean_of(std::span<const Vec3> points) {
    return std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) /
           static_cast<double>(points.size());
}

}  // namespace

Sphere fit_sphere(std::span<const Vec3> points_um) {
    const auto n = static_cast<Eigen::Index>(points_um.size());
    const Vec3 origin = mean_of(points_um);  // keeps the columns of one size
    Eigen::MatrixXd A(n, 4);
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Vec3 p = points_um[static_cast<std::size_t>(i)] - origin;
        A.row(i) << 2.0 * p.transpose(), 1.0;
        b[i] = p.squaredNorm();
    }
    const Eigen::Vector4d u = A.colPivHouseholderQr().solve(b);
    const Vec3 centre = u.head<3>();
    return {origin + centre, std::sqrt(u[3] + centre.squaredNorm())};
}

DoubletShape doublet_shape(const Snapshot& snapshot) {
    SPHEROSCOPE_ASSERT(snapshot.header->n_cells == 2 && snapshot.links.size() == 1,
                       "a doublet is two cells that touch");
    std::array<std::vector<Vec3>, 2> nodes{nodes_of_cell(snapshot, 0), nodes_of_cell(snapshot, 1)};
    const Vec3 middle = 0.5 * (mean_of(nodes[0]) + mean_of(nodes[1]));
    DoubletShape shape{};
    for (std::vector<Vec3>& cell : nodes) {
        const Vec3 outward = (mean_of(cell) - middle).normalized();
        const auto n_cap = static_cast<std::ptrdiff_t>(
            std::lround(k_cap_share * static_cast<double>(cell.size())));
        std::nth_element(
            cell.begin(), cell.begin() + n_cap, cell.end(),
            [&](const Vec3& p, const Vec3& q) { return p.dot(outward) > q.dot(outward); });
        const Sphere cap = fit_sphere(std::span(cell).first(static_cast<std::size_t>(n_cap)));
        const double h_um = (cap.centre_um - middle).dot(outward);
        shape.cos_theta += 0.5 * h_um / cap.radius_um;
        shape.cap_radius_um += 0.5 * cap.radius_um;
        shape.disc_area_um2 +=
            0.5 * std::numbers::pi * (cap.radius_um * cap.radius_um - h_um * h_um);
    }
    shape.clip_area_um2 = double{snapshot.links.front().area_um2};
    return shape;
}

}  // namespace spheroscope::test
