#include "render/layers/cell_surfaces.hpp"

#include "engine/base/error.hpp"
#include "render/layers/coloured_mesh.hpp"

#include <vtkCellData.h>

#include <algorithm>

namespace spheroscope::render {

struct CellSurfaces::Hidden : ColouredMesh {
    std::vector<int> cells;  // drawn last time

    void connect(const MeshTopology& topology);
};

CellSurfaces::CellSurfaces() : hidden_(std::make_unique<Hidden>()) {
    hidden_->actor->GetProperty()->SetInterpolationToPhong();
}

CellSurfaces::~CellSurfaces() = default;

vtkActor* CellSurfaces::actor() { return hidden_->actor; }

void CellSurfaces::Hidden::connect(const MeshTopology& topology) {
    const int n_cells = static_cast<int>(cells.size());
    const int n_triangles = topology.n_triangles();
    x_um->SetNumberOfTuples(n_cells * topology.n_nodes());
    normal->SetNumberOfTuples(n_cells * topology.n_nodes());
    corners->SetNumberOfValues(3 * n_cells * n_triangles);
    int* corner = corners->GetPointer(0);
    for (int c = 0; c < n_cells; ++c)
        for (const MeshTopology::Triangle& triangle : topology.triangles)
            for (const int node : triangle) *corner++ = c * topology.n_nodes() + node;
    connect_corners();
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
    h.mark_changed();
}

}  // namespace spheroscope::render
