#pragma once

#include "render/image.hpp"
#include "viewer/model/panel_model.hpp"

#include <memory>
#include <string>
#include <vector>

struct ImFont;

namespace spheroscope::viewer {

/// A key of the table of keys that went down (or repeats while it is held).
struct KeyPress {
    Key key;
    bool shift, control;
};

/// The window: GLFW, OpenGL and Dear ImGui. One at a time, in the program's main thread.
class Window {
  public:
    /// As large as wanted, or as the screen. Throws Error (environment) where there is no display,
    /// or none with OpenGL.
    Window(const std::string& title, int width_px, int height_px);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Waits for input, for wake() or for this time; then begins a frame of the panel. False: the
    /// window is being closed.
    [[nodiscard]] bool begin_frame(double longest_wait_s);
    /// Ends the frame: on the screen, or with nothing but its input taken.
    void draw();
    void skip_drawing();
    /// Ends the wait of begin_frame; from any thread, also where there is no window.
    static void wake();

    /// Keys since the last frame that no text field took.
    [[nodiscard]] std::vector<KeyPress> take_keys();
    /// The picture as a texture of ImGui; the texture is made once and overwritten.
    void set_picture(const render::Image& image);
    [[nodiscard]] void* picture_texture() const;
    [[nodiscard]] ImFont* small_font() const;

    /// The pixels of the frame that was shown last.
    [[nodiscard]] render::Image panel() const;
    void set_clipboard(const std::string& text);
    void close();

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::viewer
