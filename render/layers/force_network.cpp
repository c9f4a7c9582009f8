#include "render/layers/force_network.hpp"

#include "engine/base/vec3.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <numbers>

namespace spheroscope::render {

namespace {

constexpr int k_n_sides = 16;               // of a tube's cross-section
constexpr double k_unit_tube_share = 0.09;  // radius of the tube at f = 1 over the mean cell radius
constexpr double k_ball_share = 0.15;       // radius of a centre's ball over the mean cell radius
constexpr Rgb k_ball_colour{58, 60, 66};

constexpr Rgb k_weak_compression{178, 198, 232}, k_strong_compression{18, 58, 150};
constexpr Rgb k_weak_tension{246, 196, 184}, k_strong_tension{176, 18, 32};

Vec3 centre_of(const Snapshot& snapshot, int cell) {
    const std::size_t i = 3 * static_cast<std::size_t>(cell);
    return Vec3(static_cast<double>(snapshot.centre_um[i]),
                static_cast<double>(snapshot.centre_um[i + 1]),
                static_cast<double>(snapshot.centre_um[i + 2]));
}

}  // namespace

struct ForceNetwork::Hidden {
    double mean_radius_um = 0.0;
    std::shared_ptr<const MeshTopology> ball = make_icosphere(162);
    vtkNew<vtkFloatArray> x_um, normal;
    vtkNew<vtkUnsignedCharArray> colour;
    vtkNew<vtkTypeInt32Array> corners, corner_begin;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkPolyData> mesh;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;

    void add_node(const Vec3& x, const Vec3& n, Rgb c) {
        const std::array<unsigned char, 3> rgb{c.r, c.g, c.b};
        colour->InsertNextTypedTuple(rgb.data());
        normal->InsertNextTuple3(n.x(), n.y(), n.z());
        x_um->InsertNextTuple3(x.x(), x.y(), x.z());
    }
    void add_triangle(int i, int j, int k) {
        for (const int node : {i, j, k}) corners->InsertNextValue(node);
    }
    void add_ball(const Vec3& centre, double radius_um) {
        const int first = static_cast<int>(x_um->GetNumberOfTuples());
        for (const Vec3& x : ball->unit_shape)
            add_node(centre + radius_um * x.normalized(), x.normalized(), k_ball_colour);
        for (const MeshTopology::Triangle& t : ball->triangles)
            add_triangle(first + t[0], first + t[1], first + t[2]);
    }
    /// An open tube: its ends are inside the balls.
    void add_tube(const Vec3& from, const Vec3& to, double radius_um, Rgb c) {
        const Vec3 axis = (to - from).normalized();
        const Vec3 e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
        const int first = static_cast<int>(x_um->GetNumberOfTuples());
        for (int k = 0; k < k_n_sides; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / k_n_sides;
            const Vec3 outward = std::cos(angle) * e1 + std::sin(angle) * e2;
            add_node(from + radius_um * outward, outward, c);
            add_node(to + radius_um * outward, outward, c);
        }
        for (int k = 0; k < k_n_sides; ++k) {
            const int a = first + 2 * k, b = first + 2 * ((k + 1) % k_n_sides);
            add_triangle(a, b, b + 1);
            add_triangle(a, b + 1, a + 1);
        }
    }
};

ForceNetwork::ForceNetwork(double mean_radius_um) : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    h.mean_radius_um = mean_radius_um;
    h.x_um->SetNumberOfComponents(3);
    h.normal->SetNumberOfComponents(3);
    h.colour->SetNumberOfComponents(3);
    h.points->SetData(h.x_um);
    h.mesh->SetPoints(h.points);
    h.mesh->GetPointData()->SetNormals(h.normal);
    h.mesh->GetPointData()->SetScalars(h.colour);
    h.mapper->SetInputData(h.mesh);
    h.mapper->SetColorModeToDirectScalars();
    h.actor->SetMapper(h.mapper);
    h.actor->GetProperty()->SetAmbient(0.40);
    h.actor->GetProperty()->SetDiffuse(0.60);
    h.actor->GetProperty()->SetSpecular(0.0);
    h.actor->GetProperty()->BackfaceCullingOn();
}

ForceNetwork::~ForceNetwork() = default;

vtkActor* ForceNetwork::actor() { return hidden_->actor; }

double ForceNetwork::tube_radius_um(double f) const {
    return k_unit_tube_share * hidden_->mean_radius_um * std::sqrt(f);
}

Rgb ForceNetwork::tube_colour(double force_nN, double f) {
    // Half strength at the mean force, full strength from three times the mean on.
    const double strength = f < 1.0 ? 0.5 * f * f : std::min(1.0, 0.5 + 0.25 * (f - 1.0));
    return force_nN > 0.0 ? mix(k_weak_compression, k_strong_compression, strength)
                          : mix(k_weak_tension, k_strong_tension, strength);
}

NetworkCount ForceNetwork::update(const Snapshot& snapshot) {
    Hidden& h = *hidden_;
    NetworkCount count;
    count.unit_radius_um = tube_radius_um(1.0);
    count.n_links = static_cast<int>(snapshot.links.size());
    for (const ContactLink& link : snapshot.links)
        count.mean_force_nN += std::abs(static_cast<double>(link.force_nN));
    if (count.n_links > 0) count.mean_force_nN /= count.n_links;

    h.x_um->SetNumberOfTuples(0);
    h.normal->SetNumberOfTuples(0);
    h.colour->SetNumberOfTuples(0);
    h.corners->SetNumberOfValues(0);
    for (int cell = 0; cell < snapshot.header->n_cells; ++cell)
        h.add_ball(centre_of(snapshot, cell), k_ball_share * h.mean_radius_um);
    for (const ContactLink& link : snapshot.links) {
        const double force_nN = static_cast<double>(link.force_nN);
        const double f = count.mean_force_nN > 0.0 ? std::abs(force_nN) / count.mean_force_nN : 0.0;
        if (f < k_smallest_drawn) {
            ++count.n_left_out;
            continue;
        }
        h.add_tube(centre_of(snapshot, link.cell_a), centre_of(snapshot, link.cell_b),
                   tube_radius_um(f), tube_colour(force_nN, f));
    }

    const vtkIdType n_corners = h.corners->GetNumberOfValues();
    h.corner_begin->SetNumberOfValues(n_corners / 3 + 1);
    for (vtkIdType i = 0; i <= n_corners / 3; ++i)
        h.corner_begin->SetValue(i, static_cast<int>(3 * i));
    h.triangles->SetData(h.corner_begin, h.corners);
    h.mesh->SetPolys(h.triangles);
    h.x_um->Modified();
    h.normal->Modified();
    h.colour->Modified();
    h.points->Modified();
    h.mesh->Modified();
    return count;
}

}  // namespace spheroscope::render
