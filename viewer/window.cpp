// GLFW and Dear ImGui load OpenGL with dlopen, VTK gets it from libOSMesa at link time: so
// functions of OpenGL are never called by name here (that would be OSMesa's), but looked up by
// GLFW.

#include "viewer/window.hpp"

#include "engine/base/error.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

namespace spheroscope::viewer {
namespace {

/// The few functions and numbers of OpenGL 3.2 that are used here.
struct OpenGl {
    using Enum = unsigned int;
    static constexpr Enum k_texture_2d = 0x0DE1, k_min_filter = 0x2801, k_mag_filter = 0x2800;
    static constexpr Enum k_rgb = 0x1907, k_rgba = 0x1908, k_unsigned_byte = 0x1401,
                          k_colour_buffer = 0x4000;
    static constexpr Enum k_unpack_alignment = 0x0CF5, k_pack_alignment = 0x0D05;
    static constexpr int k_linear = 0x2601;

    void (*gen_textures)(int, unsigned int*);
    void (*delete_textures)(int, const unsigned int*);
    void (*bind_texture)(Enum, unsigned int);
    void (*tex_parameter)(Enum, Enum, int);
    void (*tex_image)(Enum, int, int, int, int, int, Enum, Enum, const void*);
    void (*pixel_store)(Enum, int);
    void (*viewport)(int, int, int, int);
    void (*clear_colour)(float, float, float, float);
    void (*clear)(Enum);
    void (*read_pixels)(int, int, int, int, Enum, Enum, void*);

    template <class F> static void find(F& function, const char* name) {
        function = reinterpret_cast<F>(glfwGetProcAddress(name));
        if (function == nullptr)
            throw Error(std::string("the display's OpenGL has no ") + name, "",
                        ExitCode::environment);
    }
    void find_all() {
        find(gen_textures, "glGenTextures");
        find(delete_textures, "glDeleteTextures");
        find(bind_texture, "glBindTexture");
        find(tex_parameter, "glTexParameteri");
        find(tex_image, "glTexImage2D");
        find(pixel_store, "glPixelStorei");
        find(viewport, "glViewport");
        find(clear_colour, "glClearColor");
        find(clear, "glClear");
        find(read_pixels, "glReadPixels");
    }
};

Error no_window() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return Error(std::string("the panel needs a display with OpenGL, and there is none (") +
                     (reason == nullptr ? "no reason given" : reason) + ")",
                 "`movie` and `render` make pictures without one", ExitCode::environment);
}

/// The library, so that it is left again when a window cannot be made.
struct Glfw {
    Glfw() {
        if (glfwInit() != GLFW_TRUE) throw no_window();
    }
    ~Glfw() { glfwTerminate(); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

struct WindowDeleter {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

ImFont* load_font(float size_px) {
    // Latin, Greek, superscripts, arrows, and the signs on buttons.
    static constexpr ImWchar ranges[] = {0x20,   0xFF,   0x370,  0x3FF,  0x2010,
                                         0x2030, 0x2070, 0x209F, 0x2190, 0x21FF,
                                         0x2200, 0x22FF, 0x25A0, 0x25FF, 0};
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(SPHEROSCOPE_FONT, size_px, nullptr, ranges);
}

void set_style() {
    ImGui::StyleColorsLight();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = {12.0F, 10.0F};
    style.FramePadding = {7.0F, 3.0F};
    style.ItemSpacing = {8.0F, 6.0F};
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.WindowBorderSize = 0.0F;
    style.FrameBorderSize = 1.0F;
    style.Colors[ImGuiCol_WindowBg] = {0.965F, 0.967F, 0.972F, 1.0F};
    style.Colors[ImGuiCol_ChildBg] = {1.0F, 1.0F, 1.0F, 1.0F};
    style.Colors[ImGuiCol_Text] = {0.15F, 0.16F, 0.18F, 1.0F};
    style.Colors[ImGuiCol_Border] = {0.80F, 0.81F, 0.83F, 1.0F};
}

std::optional<Key> key_of(int glfw_key) {
    switch (glfw_key) {
    case GLFW_KEY_SPACE: return Key::space;
    case GLFW_KEY_LEFT: return Key::left;
    case GLFW_KEY_RIGHT: return Key::right;
    case GLFW_KEY_HOME: return Key::home;
    case GLFW_KEY_END: return Key::end;
    case GLFW_KEY_PERIOD: return Key::period;
    case GLFW_KEY_B: return Key::b;
    case GLFW_KEY_C: return Key::c;
    case GLFW_KEY_F: return Key::f;
    case GLFW_KEY_I: return Key::i;
    case GLFW_KEY_N: return Key::n;
    case GLFW_KEY_O: return Key::o;
    case GLFW_KEY_P: return Key::p;
    case GLFW_KEY_Q: return Key::q;
    case GLFW_KEY_T: return Key::t;
    case GLFW_KEY_Y: return Key::y;
    case GLFW_KEY_Z: return Key::z;
    default: return {};
    }
}

/// Threads that have news may be there before the window is, and after it.
std::mutex g_open_mutex;
bool g_is_open = false;

}  // namespace

struct Window::Hidden {
    Glfw glfw;
    std::unique_ptr<GLFWwindow, WindowDeleter> window;
    OpenGl gl{};
    unsigned int texture = 0;
    std::vector<std::uint8_t> rgba;  // of the picture
    ImFont* small_font = nullptr;
    std::vector<KeyPress> keys;
};

Window::Window(const std::string& title, int width_px, int height_px)
    : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    int x = 0, y = 0, screen_width_px = width_px, screen_height_px = height_px;
    if (GLFWmonitor* screen = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(screen, &x, &y, &screen_width_px, &screen_height_px);
    width_px = std::min(width_px, screen_width_px);
    height_px = std::min(height_px, screen_height_px);
    h.window.reset(glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr));
    if (h.window == nullptr) throw no_window();
    glfwMakeContextCurrent(h.window.get());
    glfwSwapInterval(1);
    h.gl.find_all();
    glfwSetWindowUserPointer(h.window.get(), &h);
    // Before ImGui, which calls it in turn. Events and not states: a key that went down and up
    // between two frames counts.
    glfwSetKeyCallback(h.window.get(), [](GLFWwindow* window, int key, int, int action, int mods) {
        const std::optional<Key> known = key_of(key);
        if (action != GLFW_RELEASE && known)
            static_cast<Hidden*>(glfwGetWindowUserPointer(window))
                ->keys.push_back(
                    {*known, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
    });
    if (!std::filesystem::exists(SPHEROSCOPE_FONT))  // ImGui would abort
        throw Error("the font file " SPHEROSCOPE_FONT " cannot be read",
                    "install DejaVu Sans (Debian: fonts-dejavu-core)", ExitCode::environment);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the panel leaves no file behind that nobody asked for
    ImGui_ImplGlfw_InitForOpenGL(h.window.get(), true);
    ImGui_ImplOpenGL3_Init("#version 150");
    load_font(16.0F);
    h.small_font = load_font(13.0F);
    set_style();
    h.gl.gen_textures(1, &h.texture);
    const std::lock_guard lock(g_open_mutex);
    g_is_open = true;
}

Window::~Window() {
    {
        const std::lock_guard lock(g_open_mutex);
        g_is_open = false;
    }
    hidden_->gl.delete_textures(1, &hidden_->texture);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

bool Window::begin_frame(double longest_wait_s) {
    if (longest_wait_s > 0.0)
        glfwWaitEventsTimeout(longest_wait_s);
    else
        glfwPollEvents();
    if (glfwWindowShouldClose(hidden_->window.get()) != 0) return false;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    return true;
}

void Window::skip_drawing() { ImGui::EndFrame(); }

void Window::draw() {
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(hidden_->window.get(), &width, &height);
    hidden_->gl.viewport(0, 0, width, height);
    hidden_->gl.clear_colour(1.0F, 1.0F, 1.0F, 1.0F);
    hidden_->gl.clear(OpenGl::k_colour_buffer);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glfwSwapBuffers(hidden_->window.get());
}

void Window::wake() {
    const std::lock_guard lock(g_open_mutex);
    if (g_is_open) glfwPostEmptyEvent();
}

std::vector<KeyPress> Window::take_keys() {
    std::vector<KeyPress> keys = std::exchange(hidden_->keys, {});
    if (ImGui::GetIO().WantTextInput) keys.clear();
    return keys;
}

void Window::set_picture(const render::Image& image) {
    const OpenGl& gl = hidden_->gl;
    // Four bytes a pixel are copied as they are; of three, Mesa makes four, ten times as slowly.
    std::vector<std::uint8_t>& rgba = hidden_->rgba;
    rgba.resize(image.rgb.size() / 3 * 4);
    for (std::size_t from = 0, to = 0; from < image.rgb.size(); from += 3, to += 4) {
        rgba[to] = image.rgb[from];
        rgba[to + 1] = image.rgb[from + 1];
        rgba[to + 2] = image.rgb[from + 2];
        rgba[to + 3] = 255;
    }
    gl.bind_texture(OpenGl::k_texture_2d, hidden_->texture);
    gl.tex_parameter(OpenGl::k_texture_2d, OpenGl::k_min_filter, OpenGl::k_linear);
    gl.tex_parameter(OpenGl::k_texture_2d, OpenGl::k_mag_filter, OpenGl::k_linear);
    gl.pixel_store(OpenGl::k_unpack_alignment, 4);
    gl.tex_image(OpenGl::k_texture_2d, 0, static_cast<int>(OpenGl::k_rgba), image.width,
                 image.height, 0, OpenGl::k_rgba, OpenGl::k_unsigned_byte, rgba.data());
}

void* Window::picture_texture() const {
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(hidden_->texture));
}

ImFont* Window::small_font() const { return hidden_->small_font; }

render::Image Window::panel() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(hidden_->window.get(), &width, &height);
    render::Image upside_down(width, height), image(width, height);
    hidden_->gl.pixel_store(OpenGl::k_pack_alignment, 1);
    hidden_->gl.read_pixels(0, 0, width, height, OpenGl::k_rgb, OpenGl::k_unsigned_byte,
                            upside_down.rgb.data());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, upside_down.at(x, height - 1 - y));
    return image;
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(hidden_->window.get(), text.c_str());
}

void Window::close() { glfwSetWindowShouldClose(hidden_->window.get(), GLFW_TRUE); }

}  // namespace spheroscope::viewer
