#pragma once

#include "engine/run/principal_stress.hpp"
#include "render/layers/tubes.hpp"

#include <span>

namespace spheroscope::render {

/// The principal axes of the cells' stress: three rods through the centre of each cell, their
/// lengths proportional to the stress along them, red for tension, blue for compression.
class StressAxes {
  public:
    /// mean_radius_um: of the cells; the longest rod of a frame is as long as their diameter.
    explicit StressAxes(double mean_radius_um) : mean_radius_um_(mean_radius_um) {}

    /// Returns the largest principal stress of these cells, kPa, which the longest rod stands for.
    double update(const Snapshot& snapshot, const StressComponents& components,
                  std::span<const int> cells);
    [[nodiscard]] vtkActor* actor() { return rods_.actor(); }

    [[nodiscard]] static Rgb rod_colour(double stress_kPa);

  private:
    double mean_radius_um_;
    Tubes rods_;
};

}  // namespace spheroscope::render
