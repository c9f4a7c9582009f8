#pragma once

#include "engine/run/snapshot.hpp"

#include <memory>

class vtkActor;

namespace spheroscope::render {

/// Hull and probe of an indentation. What lies behind the cells is drawn as it is: the inner sides
/// of the hull and of the probe, as of a cup and a bowl. The probe's near side is glass. So nothing
/// hides a cell.
class LoadSurfaces {
  public:
    LoadSurfaces();
    ~LoadSurfaces();

    /// Precondition: a probe acts in this frame.
    void update(const Snapshot& snapshot);
    [[nodiscard]] vtkActor* hull_behind();
    [[nodiscard]] vtkActor* probe_behind();
    [[nodiscard]] vtkActor* probe_in_front();

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

/// How much of what is behind the glass is lost.
inline constexpr double k_glass_opacity = 0.30;

}  // namespace spheroscope::render
