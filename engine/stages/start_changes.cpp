#include "engine/stages/start_changes.hpp"

#include <Eigen/Geometry>

namespace spheroscope {
namespace {

Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Vec3 centre_of(std::span<const Vec3> x) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& node : x) sum += node;
    return sum / static_cast<double>(x.size());
}

/// Moves the third corner to height_um above the middle of the opposite edge, in the triangle's
/// plane.
void make_sliver(const MeshTopology::Triangle& triangle, double height_um, std::span<Vec3> x) {
    const auto node = [&](std::size_t k) -> Vec3& {
        return x[static_cast<std::size_t>(triangle[k])];
    };
    const Vec3 along = (node(1) - node(0)).normalized();
    const Vec3 middle = 0.5 * (node(0) + node(1));
    const Vec3 to_corner = node(2) - middle;
    const Vec3 up = (to_corner - along * along.dot(to_corner)).normalized();
    node(2) = middle + height_um * up;
}

}  // namespace

Mat3 start_rotation(const scene::Start& start) {
    const Vec3 axis = vector_of(start.turn_axis);
    SPHEROSCOPE_ASSERT(axis.norm() > 0.0, "scenes with another axis are refused");
    return Eigen::AngleAxisd(start.turn_rad, axis.normalized()).toRotationMatrix();
}

void change_start(const scene::Start& start, const Model& model, std::span<Vec3> x_um) {
    const Vec3 stretch = vector_of(start.stretch);
    const Mat3 rotation = start_rotation(start);
    const Vec3 shift_um = vector_of(start.shift_um);
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const std::span<Vec3> x = model.cell_nodes(x_um, cell);
        const Vec3 centre = centre_of(x);
        // what is not asked for does not even round
        if (stretch != Vec3::Ones())
            for (Vec3& node : x) node = centre + stretch.cwiseProduct(node - centre);
        if (start.sliver_height_um > 0.0)
            make_sliver(model.topology->triangles[0], start.sliver_height_um, x);
        if (start.turn_rad != 0.0)
            for (Vec3& node : x) node = rotation * node;
        if (shift_um != Vec3::Zero())
            for (Vec3& node : x) node += shift_um;
    }
}

}  // namespace spheroscope
