#pragma once

#include "engine/run/snapshot.hpp"
#include "render/image.hpp"

#include <memory>

class vtkActor;

namespace spheroscope::render {

/// What the network's key says about a frame.
struct NetworkCount {
    int n_links = 0;              ///< touching pairs of cells
    int n_left_out = 0;           ///< with f below k_smallest_drawn
    double mean_force_nN = 0.0;   ///< <|F|> over all touching pairs; 0 if there are none
    double unit_radius_um = 0.0;  ///< of a tube with f = 1
};

/// The contact forces between cells: a tube from centre to centre for each touching pair, its
/// radius growing with the root of f = |F| / <|F|> (its cross-section with f), blue for
/// compression, red for tension, pale below the mean. Centres are small dark balls.
class ForceNetwork {
  public:
    static constexpr double k_smallest_drawn = 0.1;  ///< f; thinner tubes would not be seen

    /// mean_radius_um: of the cells; sets the thickness of tubes.
    explicit ForceNetwork(double mean_radius_um);
    ~ForceNetwork();

    NetworkCount update(const Snapshot& snapshot);
    [[nodiscard]] vtkActor* actor();

    /// Radius of a tube, um.
    [[nodiscard]] double tube_radius_um(double f) const;
    /// Colour of a tube; force > 0 is compression.
    [[nodiscard]] static Rgb tube_colour(double force_nN, double f);

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::render
