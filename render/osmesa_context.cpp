// OSMesa has left newer Mesa; when EGL replaces it, this file and glx_definitions.cpp change.
//
// Debian's VTK has X11 windows and 'generic' ones that live in somebody else's context. A generic
// window in an OSMesa context works when (a) libOSMesa is the first library that defines OpenGL's
// functions, (b) the executable leads GLEW to OSMesa (glx_definitions.cpp). A program that lacks
// (a) draws one colour and says nothing: hence the probe. vtkRenderWindow::New() must not be
// called: it makes an X11 window.

#include "render/osmesa_context.hpp"

#include "engine/base/error.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkVersion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <thread>

namespace spheroscope::render {

namespace {

Error no_opengl(const std::string& what) {
    return Error("no pictures can be drawn: " + what,
                 "pictures need Mesa's libOSMesa (Debian: libosmesa6) and VTK 9 (libvtk9.1)",
                 ExitCode::environment);
}

/// A program that was linked without spheroscope_use_render (render/CMakeLists.txt) would crash
/// inside VTK.
void check_that_opengl_is_mesa() {
    using Resolve = void (*(*)(const unsigned char*))();  // as glx_definitions.cpp has it
    const auto resolve = reinterpret_cast<Resolve>(dlsym(RTLD_DEFAULT, "glXGetProcAddressARB"));
    const auto* const clear = reinterpret_cast<const unsigned char*>("glClear");
    if (resolve == nullptr || resolve(clear) != OSMesaGetProcAddress("glClear"))
        throw no_opengl("the program does not lead OpenGL's functions to OSMesa");
    Dl_info owner{};
    if (dladdr(dlsym(RTLD_DEFAULT, "glClear"), &owner) == 0 ||
        std::string(owner.dli_fname).find("libOSMesa") == std::string::npos)
        throw no_opengl("another OpenGL library comes before libOSMesa");
}

/// The OSMesa context alone, so that it outlives every VTK object that was made in it.
class MesaContext {
  public:
    MesaContext() {
        check_that_opengl_is_mesa();
        constexpr std::array<int, 15> attributes{OSMESA_FORMAT,
                                                 OSMESA_RGBA,
                                                 OSMESA_DEPTH_BITS,
                                                 24,
                                                 OSMESA_STENCIL_BITS,
                                                 8,
                                                 OSMESA_PROFILE,
                                                 OSMESA_CORE_PROFILE,
                                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                                 3,
                                                 OSMESA_CONTEXT_MINOR_VERSION,
                                                 2,
                                                 0,
                                                 0,
                                                 0};
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (context_ == nullptr) throw no_opengl("OSMesa gives no OpenGL 3.2 context");
        if (try_make_current()) return;
        OSMesaDestroyContext(context_);  // the destructor will not run
        throw not_current();
    }
    ~MesaContext() { OSMesaDestroyContext(context_); }
    MesaContext(const MesaContext&) = delete;
    MesaContext& operator=(const MesaContext&) = delete;

    void make_current() {
        if (!try_make_current()) throw not_current();
    }
    [[nodiscard]] bool try_make_current() noexcept {
        if (OSMesaGetCurrentContext() == context_) return true;
        // VTK draws into its own framebuffer; this one is never shown and can be tiny.
        return OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, k_side, k_side) ==
               GL_TRUE;
    }

  private:
    static Error not_current() { return no_opengl("the OSMesa context cannot be made current"); }

    static constexpr int k_side = 16;
    OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, std::size_t{4} * k_side * k_side> pixels_{};
};

}  // namespace

struct OsmesaContext::Hidden {
    MesaContext mesa;  // first: destroyed last
    std::thread::id thread = std::this_thread::get_id();
    int width = 0, height = 0;
    vtkNew<vtkGenericOpenGLRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkLight> light;
};

OsmesaContext::OsmesaContext(int width_px, int height_px) : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    h.width = width_px;
    h.height = height_px;
    h.window->SetOwnContext(0);
    h.window->SetIsDirect(1);
    h.window->SetSupportsOpenGL(1);
    h.window->SetIsCurrent(true);
    h.window->SetReadyForRendering(true);
    h.window->SetMapped(1);
    h.window->SetMultiSamples(0);
    h.window->SetSize(width_px, height_px);
    h.window->SetFrameBlitModeToNoBlit();
    h.window->InitializeFromCurrentContext();
    h.window->AddRenderer(h.renderer);
    h.renderer->SetBackground(1.0, 1.0, 1.0);
    h.renderer->AutomaticLightCreationOff();
    // A lamp fixed to the eye, a little up and to the left: the eye takes light from there for
    // granted.
    h.light->SetLightTypeToCameraLight();
    h.light->SetPosition(-0.12, 0.18, 1.0);
    h.light->SetFocalPoint(0.0, 0.0, 0.0);
    h.light->PositionalOff();
    h.renderer->AddLight(h.light);
    probe();
}

OsmesaContext::~OsmesaContext() {
    SPHEROSCOPE_ASSERT(hidden_->thread == std::this_thread::get_id(),
                       "an OSMesa context is destroyed by the thread that made it");
    // Without its context there is nothing that VTK could release.
    if (hidden_->mesa.try_make_current()) hidden_->window->Finalize();
}

void OsmesaContext::set_size(int width_px, int height_px) {
    Hidden& h = *hidden_;
    if (width_px == h.width && height_px == h.height) return;
    h.mesa.make_current();
    h.width = width_px;
    h.height = height_px;
    h.window->SetSize(width_px, height_px);
}

void OsmesaContext::draw(vtkActor* actor, const Camera& camera, double reach_um, Buffers& buffers) {
    Hidden& h = *hidden_;
    SPHEROSCOPE_ASSERT(h.thread == std::this_thread::get_id(),
                       "an OSMesa context is used by the thread that made it");
    h.mesa.make_current();

    // The camera's focal point may lie off the middle of the picture; VTK's is always in the
    // middle.
    const Vec3 middle = camera.focal_um +
                        camera.right * ((0.5 * h.width - camera.centre_x_px) / camera.px_per_um) +
                        camera.up * ((camera.centre_y_px - 0.5 * h.height) / camera.px_per_um);
    const Vec3 eye = middle + camera.towards_eye * (2.0 * reach_um);
    vtkCamera* vtk_camera = h.renderer->GetActiveCamera();
    vtk_camera->ParallelProjectionOn();
    vtk_camera->SetParallelScale(0.5 * h.height / camera.px_per_um);
    vtk_camera->SetFocalPoint(middle.x(), middle.y(), middle.z());
    vtk_camera->SetPosition(eye.x(), eye.y(), eye.z());
    vtk_camera->SetViewUp(camera.up.x(), camera.up.y(), camera.up.z());
    vtk_camera->SetClippingRange(reach_um, 3.0 * reach_um);

    h.renderer->AddActor(actor);
    h.window->Render();
    h.renderer->RemoveActor(actor);

    read_colours(buffers);
    buffers.depth_range_um = 2.0 * reach_um;
    buffers.depth.resize(buffers.rgba.size() / 4);
    glReadPixels(0, 0, h.width, h.height, GL_DEPTH_COMPONENT, GL_FLOAT, buffers.depth.data());
}

void OsmesaContext::read_colours(Buffers& buffers) {
    Hidden& h = *hidden_;
    buffers.width = h.width;
    buffers.height = h.height;
    buffers.rgba.resize(4 * static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height));
    h.window->GetRenderFramebuffer()->Bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, h.width, h.height, GL_RGBA, GL_UNSIGNED_BYTE, buffers.rgba.data());
}

std::string OsmesaContext::description() {
    hidden_->mesa.make_current();
    const auto text = [](GLenum name) {
        const GLubyte* words = glGetString(name);
        return words == nullptr ? std::string("?") : reinterpret_cast<const char*>(words);
    };
    // "4.5 (Core Profile) Mesa 22.3.6"
    const std::string version = text(GL_VERSION);
    const std::size_t mesa = version.find("Mesa ");
    return text(GL_RENDERER) + ", " +
           (mesa == std::string::npos ? "OpenGL " + version : version.substr(mesa)) + ", VTK " +
           vtkVersion::GetVTKVersion();
}

void OsmesaContext::lend(const Work& work) {
    SPHEROSCOPE_ASSERT(hidden_->thread == std::this_thread::get_id(),
                       "an OSMesa context is used by the thread that made it");
    hidden_->mesa.make_current();
    work(hidden_->window, hidden_->renderer);
}

void OsmesaContext::probe() {
    // A green square over the left half of a white picture.
    vtkNew<vtkPoints> corners;
    corners->InsertNextPoint(0.0, -1.0, -1.0);
    corners->InsertNextPoint(0.0, 0.0, -1.0);
    corners->InsertNextPoint(0.0, 0.0, 1.0);
    corners->InsertNextPoint(0.0, -1.0, 1.0);
    vtkNew<vtkCellArray> square;
    const std::array<vtkIdType, 4> order{0, 1, 2, 3};
    square->InsertNextCell(4, order.data());
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(corners);
    shape->SetPolys(square);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(shape);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0.0, 1.0, 0.0);

    Hidden& h = *hidden_;
    Camera camera = make_camera(Vec3::Zero(), 0.0, 0.0);
    camera.px_per_um = 0.5 * h.height;
    camera.centre_x_px = 0.5 * h.width;
    camera.centre_y_px = 0.5 * h.height;
    Buffers seen;
    draw(actor, camera, 10.0, seen);
    actor->ReleaseGraphicsResources(h.window);

    const int row = h.height / 2;
    const auto pixel = [&](int column) {
        const std::size_t i =
            4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(h.width) +
                 static_cast<std::size_t>(column));
        return std::array<int, 3>{seen.rgba[i], seen.rgba[i + 1], seen.rgba[i + 2]};
    };
    const int reach = std::max(1, std::min(h.width, h.height) / 4);
    const auto left = pixel(h.width / 2 - reach), right = pixel(h.width / 2 + reach);
    if (left != std::array<int, 3>{0, 255, 0} || right != std::array<int, 3>{255, 255, 255}) {
        const auto text = [](const std::array<int, 3>& c) {
            return "(" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " +
                   std::to_string(c[2]) + ")";
        };
        throw no_opengl("a test picture of green beside white came out as " + text(left) +
                        " beside " + text(right));
    }
}

}  // namespace spheroscope::render
