#include "render/layers/load_surfaces.hpp"

#include "engine/model/mesh_topology.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <array>

namespace spheroscope::render {
namespace {

/// A closed or open surface with one colour, of which one side is drawn.
struct Surface {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normal;
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkPolyData> mesh;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> inner, outer;

    explicit Surface(const std::array<double, 3>& colour) {
        normal->SetNumberOfComponents(3);
        mesh->SetPoints(points);
        mesh->SetPolys(triangles);
        mapper->SetInputData(mesh);
        for (vtkActor* actor : {inner.Get(), outer.Get()}) {
            actor->SetMapper(mapper);
            actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
            actor->GetProperty()->SetAmbient(0.45);
            actor->GetProperty()->SetDiffuse(0.55);
            actor->GetProperty()->SetSpecular(0.0);
        }
        inner->GetProperty()->FrontfaceCullingOn();
        outer->GetProperty()->BackfaceCullingOn();
    }
    void add_point(const Vec3& x) { points->InsertNextPoint(x.x(), x.y(), x.z()); }
    void add_triangle(const std::array<int, 3>& corners) {
        const std::array<vtkIdType, 3> ids{corners[0], corners[1], corners[2]};
        triangles->InsertNextCell(3, ids.data());
    }
    void changed() {
        points->Modified();
        triangles->Modified();
        mesh->Modified();
    }
};

}  // namespace

struct LoadSurfaces::Hidden {
    Surface hull{{0.90, 0.90, 0.88}};
    Surface probe{{0.78, 0.82, 0.87}};
    std::shared_ptr<const Hull> drawn_hull;
    std::shared_ptr<const MeshTopology> sphere = make_icosphere(2562);
};

LoadSurfaces::LoadSurfaces() : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    for (const Vec3& x : h.sphere->unit_shape) {
        const Vec3 n = x.normalized();
        h.probe.normal->InsertNextTuple3(n.x(), n.y(), n.z());
    }
    h.probe.mesh->GetPointData()->SetNormals(h.probe.normal);
    for (const MeshTopology::Triangle& triangle : h.sphere->triangles)
        h.probe.add_triangle(triangle);
}

LoadSurfaces::~LoadSurfaces() = default;

void LoadSurfaces::update(const Snapshot& snapshot) {
    Hidden& h = *hidden_;
    if (h.drawn_hull != snapshot.load.hull) {
        h.drawn_hull = snapshot.load.hull;
        h.hull.points->Reset();
        h.hull.triangles->Reset();
        for (const Vec3& x : h.drawn_hull->vertex_um) h.hull.add_point(x);
        for (const auto& triangle : h.drawn_hull->triangle) h.hull.add_triangle(triangle);
        h.hull.changed();
    }
    const Probe& probe = snapshot.load.probe;
    h.probe.points->Reset();
    for (const Vec3& x : h.sphere->unit_shape)
        h.probe.add_point(probe.centre_um() + probe.radius_um * x.normalized());
    h.probe.changed();
}

vtkActor* LoadSurfaces::hull_behind() { return hidden_->hull.inner; }
vtkActor* LoadSurfaces::probe_behind() { return hidden_->probe.inner; }
vtkActor* LoadSurfaces::probe_in_front() { return hidden_->probe.outer; }

}  // namespace spheroscope::render
