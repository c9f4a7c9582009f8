#pragma once

#include "render/camera.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkRenderWindow;
class vtkRenderer;

namespace spheroscope::render {

/// What the graphics library drew: rows from the bottom.
struct Buffers {
    int width = 0, height = 0;
    /// [height * width * 4]; as Mesa keeps it, so that reading is copying. The fourth byte means
    /// nothing.
    std::vector<std::uint8_t> rgba;
    std::vector<float> depth;     ///< [height * width] 0 near ... 1 far, 1: nothing there; linear
    double depth_range_um = 0.0;  ///< distance between depth 0 and depth 1
};

/// Draws VTK actors into memory through OSMesa (Mesa's software renderer), without a display.
/// Everything that knows of OSMesa is in this file's source and in glx_definitions.cpp.
///
/// One thread creates, uses and destroys it. The constructor draws two colours and reads them back;
/// it throws Error with ExitCode::environment when that does not give the two colours.
class OsmesaContext {
  public:
    OsmesaContext(int width_px, int height_px);
    ~OsmesaContext();
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    /// Of all that is drawn from now on.
    void set_size(int width_px, int height_px);

    /// Draws one actor on white. `camera` is in pixels of this context; everything within reach_um
    /// of its focal point is inside the depth range.
    void draw(vtkActor* actor, const Camera& camera, double reach_um, Buffers& buffers);

    /// Lends window and renderer, with the context current, to somebody who draws with VTK's own
    /// tools (charts). What it adds to the renderer it also removes.
    using Work = std::function<void(vtkRenderWindow*, vtkRenderer*)>;
    void lend(const Work& work);
    /// What draws: "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6, VTK 9.1.0". Pictures are the
    /// same bits where this is the same text.
    [[nodiscard]] std::string description();
    /// Colours of what was rendered last.
    void read_colours(Buffers& buffers);

  private:
    struct Hidden;
    void probe();

    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::render
