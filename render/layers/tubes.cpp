#include "render/layers/tubes.hpp"

#include "engine/model/mesh_topology.hpp"
#include "render/layers/coloured_mesh.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace spheroscope::render {

namespace {

constexpr int k_n_sides = 16;  // of a tube's cross-section

}  // namespace

struct Tubes::Hidden : ColouredMesh {
    std::shared_ptr<const MeshTopology> ball = make_icosphere(162);

    [[nodiscard]] int n_nodes() const { return static_cast<int>(x_um->GetNumberOfTuples()); }
    void add_node(const Vec3& x, const Vec3& n, Rgb c) {
        const std::array<unsigned char, 3> rgb{c.r, c.g, c.b};
        colour->InsertNextTypedTuple(rgb.data());
        normal->InsertNextTuple3(n.x(), n.y(), n.z());
        x_um->InsertNextTuple3(x.x(), x.y(), x.z());
    }
    void add_triangle(int i, int j, int k) {
        for (const int node : {i, j, k}) corners->InsertNextValue(node);
    }
    /// A disc that faces along `axis`.
    void add_disc(const Vec3& centre, const Vec3& axis, double radius_um, Rgb c) {
        const Vec3 e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
        const int first = n_nodes();
        add_node(centre, axis, c);
        for (int k = 0; k < k_n_sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / k_n_sides;
            add_node(centre + radius_um * (std::cos(angle) * e1 + std::sin(angle) * e2), axis, c);
        }
        for (int k = 0; k < k_n_sides; ++k)
            add_triangle(first, first + 1 + k, first + 1 + (k + 1) % k_n_sides);
    }
};

Tubes::Tubes() : hidden_(std::make_unique<Hidden>()) {
    hidden_->mesh->GetPointData()->SetScalars(hidden_->colour);
}

Tubes::~Tubes() = default;

vtkActor* Tubes::actor() { return hidden_->actor; }

void Tubes::clear() {
    Hidden& h = *hidden_;
    h.x_um->SetNumberOfTuples(0);
    h.normal->SetNumberOfTuples(0);
    h.colour->SetNumberOfTuples(0);
    h.corners->SetNumberOfValues(0);
}

void Tubes::add_ball(const Vec3& centre, double radius_um, Rgb colour) {
    Hidden& h = *hidden_;
    const int first = h.n_nodes();
    for (const Vec3& x : h.ball->unit_shape)
        h.add_node(centre + radius_um * x.normalized(), x.normalized(), colour);
    for (const MeshTopology::Triangle& t : h.ball->triangles)
        h.add_triangle(first + t[0], first + t[1], first + t[2]);
}

void Tubes::add_tube(const Vec3& from, const Vec3& to, double radius_um, Rgb colour) {
    Hidden& h = *hidden_;
    const Vec3 axis = (to - from).normalized();
    const Vec3 e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
    const int first = h.n_nodes();
    for (int k = 0; k < k_n_sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / k_n_sides;
        const Vec3 outward = std::cos(angle) * e1 + std::sin(angle) * e2;
        h.add_node(from + radius_um * outward, outward, colour);
        h.add_node(to + radius_um * outward, outward, colour);
    }
    for (int k = 0; k < k_n_sides; ++k) {
        const int a = first + 2 * k, b = first + 2 * ((k + 1) % k_n_sides);
        h.add_triangle(a, b, b + 1);
        h.add_triangle(a, b + 1, a + 1);
    }
}

void Tubes::add_rod(const Vec3& from, const Vec3& to, double radius_um, Rgb colour) {
    const Vec3 axis = (to - from).normalized();
    add_tube(from, to, radius_um, colour);
    hidden_->add_disc(to, axis, radius_um, colour);
    hidden_->add_disc(from, -axis, radius_um, colour);
}

void Tubes::finish() {
    Hidden& h = *hidden_;
    h.connect_corners();
    h.mark_changed();
}

}  // namespace spheroscope::render
