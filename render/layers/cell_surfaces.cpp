#include "render/layers/cell_surfaces.hpp"

#include "engine/base/error.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace spheroscope::render {

struct CellSurfaces::Hidden {
    std::vector<int> cells;  // drawn last time
    vtkNew<vtkFloatArray> x_um, normal;
    vtkNew<vtkUnsignedCharArray> colour;
    vtkNew<vtkTypeInt32Array> corners, corner_begin;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkPolyData> mesh;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;

    void connect(const MeshTopology& topology);
};

CellSurfaces::CellSurfaces() : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    h.x_um->SetNumberOfComponents(3);
    h.normal->SetNumberOfComponents(3);
    h.colour->SetNumberOfComponents(3);
    h.points->SetData(h.x_um);
    h.mesh->SetPoints(h.points);
    h.mesh->GetPointData()->SetNormals(h.normal);
    h.mapper->SetInputData(h.mesh);
    h.mapper->SetColorModeToDirectScalars();
    h.actor->SetMapper(h.mapper);
    // Shading shows the shape and must not be taken for stress: much ambient light, no highlights.
    h.actor->GetProperty()->SetAmbient(0.40);
    h.actor->GetProperty()->SetDiffuse(0.60);
    h.actor->GetProperty()->SetSpecular(0.0);
    h.actor->GetProperty()->SetInterpolationToPhong();
    // Surfaces are closed and wound outward: the inner side is never seen, and half the work is
    // saved.
    h.actor->GetProperty()->BackfaceCullingOn();
}

CellSurfaces::~CellSurfaces() = default;

vtkActor* CellSurfaces::actor() { return hidden_->actor; }

void CellSurfaces::Hidden::connect(const MeshTopology& topology) {
    const int n_cells = static_cast<int>(cells.size());
    const int n_triangles = topology.n_triangles();
    x_um->SetNumberOfTuples(n_cells * topology.n_nodes());
    normal->SetNumberOfTuples(n_cells * topology.n_nodes());
    corners->SetNumberOfValues(3 * n_cells * n_triangles);
    corner_begin->SetNumberOfValues(n_cells * n_triangles + 1);
    int* corner = corners->GetPointer(0);
    for (int c = 0; c < n_cells; ++c)
        for (const MeshTopology::Triangle& triangle : topology.triangles)
            for (const int node : triangle) *corner++ = c * topology.n_nodes() + node;
    for (int i = 0; i <= n_cells * n_triangles; ++i) corner_begin->SetValue(i, 3 * i);
    triangles->SetData(corner_begin, corners);
    mesh->SetPolys(triangles);
}

void CellSurfaces::update(const Snapshot& snapshot, std::span<const int> cells, Place place,
                          std::span<const Rgb> colours) {
    Hidden& h = *hidden_;
    const MeshTopology& topology = *snapshot.header->topology;
    if (h.cells.size() != cells.size() ||
        !std::equal(cells.begin(), cells.end(), h.cells.begin())) {
        h.cells.assign(cells.begin(), cells.end());
        h.connect(topology);
    }

    const std::size_t n_floats = 3 * static_cast<std::size_t>(topology.n_nodes());
    float* x_um = h.x_um->GetPointer(0);
    float* normal = h.normal->GetPointer(0);
    for (const int cell : cells) {
        const auto begin = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(cell) * n_floats);
        const auto end = begin + static_cast<std::ptrdiff_t>(n_floats);
        x_um = std::copy(snapshot.x_um.begin() + begin, snapshot.x_um.begin() + end, x_um);
        normal = std::copy(snapshot.normal.begin() + begin, snapshot.normal.begin() + end, normal);
    }

    // A value of a cell is given to all its nodes: cells share none.
    const bool on_triangles = place == Place::triangle;
    const int n_each = on_triangles ? topology.n_triangles() : topology.n_nodes();
    [[maybe_unused]] const std::size_t n_given =
        cells.size() * (place == Place::cell ? 1U : static_cast<std::size_t>(n_each));
    SPHEROSCOPE_ASSERT(colours.size() == n_given, "one colour for each value of the drawn cells");
    h.colour->SetNumberOfTuples(static_cast<vtkIdType>(cells.size()) * n_each);
    unsigned char* out = h.colour->GetPointer(0);
    const int n_repeats = place == Place::cell ? n_each : 1;
    for (const Rgb colour : colours)
        for (int k = 0; k < n_repeats; ++k) {
            *out++ = colour.r;
            *out++ = colour.g;
            *out++ = colour.b;
        }

    h.mesh->GetPointData()->SetScalars(on_triangles ? nullptr : h.colour.Get());
    h.mesh->GetCellData()->SetScalars(on_triangles ? h.colour.Get() : nullptr);
    if (on_triangles)
        h.mapper->SetScalarModeToUseCellData();
    else
        h.mapper->SetScalarModeToUsePointData();
    h.x_um->Modified();
    h.normal->Modified();
    h.colour->Modified();
    h.points->Modified();
    h.mesh->Modified();
}

}  // namespace spheroscope::render
