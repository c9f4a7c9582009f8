#pragma once

#include "engine/run/snapshot.hpp"
#include "render/image.hpp"

#include <memory>
#include <span>
#include <vector>

class vtkActor;

namespace spheroscope::render {

/// The surfaces of cells as one merged mesh, shaded with the engine's node normals. Its arrays are
/// made once for a set of drawn cells and then only overwritten.
class CellSurfaces {
  public:
    CellSurfaces();
    ~CellSurfaces();

    /// Takes over positions and colours.
    /// cells: the cells to draw, ascending; colours: of these cells only, in their order, one for
    /// each node, triangle or cell as `place` says.
    void update(const Snapshot& snapshot, std::span<const int> cells, Place place,
                std::span<const Rgb> colours);
    [[nodiscard]] vtkActor* actor();

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::render
