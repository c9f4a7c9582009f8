#include "engine/model/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {

void Geometry::allocate(const Model& model, Need needs) {
    if (has(needs, Need::triangles)) {
        normal.resize(model.n_all_triangles());
        area_um2.resize(model.n_all_triangles());
        centroid_um.resize(model.n_all_triangles());
        reach_um.resize(model.n_all_triangles());
    }
    if (has(needs, Need::volumes)) {
        volume_um3.resize(model.radius_um.size());
        volume_gradient_um2.resize(model.n_all_nodes());
        centre_um.resize(model.radius_um.size());
    }
}

void Geometry::compute_cell(const Model& model, std::span<const Vec3> x_um, Need needs, int cell) {
    const MeshTopology& mesh = *model.topology;
    const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
    const auto at = [&](int node) -> const Vec3& { return x[static_cast<std::size_t>(node)]; };
    if (has(needs, Need::triangles)) {
        const std::size_t first =
            static_cast<std::size_t>(cell) * static_cast<std::size_t>(mesh.n_triangles());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [i, j, k] = mesh.triangles[t];
            const Vec3 m = (at(j) - at(i)).cross(at(k) - at(i));
            const double length = m.norm();
            normal[first + t] = m / length;
            area_um2[first + t] = 0.5 * length;
            // Offsets from a corner, so that a mesh far from the origin keeps its digits.
            const Vec3 c = ((at(j) - at(i)) + (at(k) - at(i))) / 3.0;
            centroid_um[first + t] = at(i) + c;
            reach_um[first + t] =
                std::sqrt(std::max({c.squaredNorm(), (at(j) - at(i) - c).squaredNorm(),
                                    (at(k) - at(i) - c).squaredNorm()}));
        }
    }
    if (has(needs, Need::volumes)) {
        const auto c = static_cast<std::size_t>(cell);
        const std::span<Vec3> gradient =
            model.cell_nodes(std::span<Vec3>(volume_gradient_um2), cell);
        std::fill(gradient.begin(), gradient.end(), Vec3::Zero());
        Vec3 centre = Vec3::Zero();
        const Vec3 origin = at(0);
        for (const Vec3& node : x) centre += node - origin;
        centre = origin + centre / static_cast<double>(x.size());
        double six_volumes = 0.0;
        for (const auto& [i, j, k] : mesh.triangles) {
            // V = 1/6 sum x_i . (x_j x x_k), from the cell's own centre: on a closed surface
            // neither V nor its gradient depends on the origin, but their rounding errors do.
            const Vec3 xi = at(i) - centre, xj = at(j) - centre, xk = at(k) - centre;
            const Vec3 jk = xj.cross(xk);
            six_volumes += xi.dot(jk);
            gradient[static_cast<std::size_t>(i)] += jk / 6.0;
            gradient[static_cast<std::size_t>(j)] += xk.cross(xi) / 6.0;
            gradient[static_cast<std::size_t>(k)] += xi.cross(xj) / 6.0;
        }
        volume_um3[c] = six_volumes / 6.0;
        centre_um[c] = centre;
    }
}

}  // namespace spheroscope
