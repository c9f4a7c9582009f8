#include "engine/model/model.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace spheroscope {

double Model::rest_volume_um3(int cell) const {
    const double R = radius_um[static_cast<std::size_t>(cell)];
    return 4.0 / 3.0 * std::numbers::pi * R * R * R;
}

double hinge_angle(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b) {
    const Vec3 e = j - i;
    const Vec3 m_left = e.cross(a - i);
    const Vec3 m_right = (b - i).cross(e);
    // m_left x m_right points along the edge when the hinge is convex, against it when concave.
    return std::atan2(m_left.cross(m_right).dot(e) / e.norm(), m_left.dot(m_right));
}

Model make_model(std::shared_ptr<const MeshTopology> topology, std::vector<double> radius_um,
                 double target_strain) {
    Model model;
    model.topology = std::move(topology);
    model.radius_um = std::move(radius_um);
    const MeshTopology& mesh = *model.topology;
    const auto at = [&](int node) -> const Vec3& {
        return mesh.unit_shape[static_cast<std::size_t>(node)];
    };
    model.unit_node_area.assign(mesh.unit_shape.size(), 0.0);
    for (const auto& [i, j, k] : mesh.triangles) {
        const double area = 0.5 * (at(j) - at(i)).cross(at(k) - at(i)).norm();
        model.unit_triangle_area.push_back(area);
        model.unit_area += area;
        for (const int node : {i, j, k})
            model.unit_node_area[static_cast<std::size_t>(node)] += area / 3.0;
    }
    for (const MeshTopology::Edge& e : mesh.edges) {
        model.unit_edge_length.push_back((at(e.j) - at(e.i)).norm());
        const double theta_rad = hinge_angle(at(e.i), at(e.j), at(e.a), at(e.b));
        model.rest_hinge_angle_rad.push_back(theta_rad);
        model.rest_hinge_cosine.push_back(std::cos(theta_rad));
        model.rest_hinge_sine.push_back(std::sin(theta_rad));
    }
    for (int cell = 0; cell < model.n_cells(); ++cell)
        model.target_volume_um3.push_back((1.0 + target_strain) * model.rest_volume_um3(cell));
    return model;
}

}  // namespace spheroscope
