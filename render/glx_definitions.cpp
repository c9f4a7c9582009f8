// Debian's VTK finds OpenGL through a GLEW that was built for GLX. In a program without X the three
// GLX functions that GLEW calls must lead to OSMesa; the dynamic linker takes the executable's
// definition before any library's, so this file is compiled into every executable that draws
// (spheroscope_use_render in render/CMakeLists.txt), never into a library.
//
// Programs that open a window beside it (GLFW) load GLX with dlopen and are not reached by these.

#include <GL/osmesa.h>

#include <cstring>

extern "C" {

using GlFunction = void (*)();

GlFunction glXGetProcAddressARB(const unsigned char* name);
GlFunction glXGetProcAddress(const unsigned char* name);
int glXQueryVersion(void* display, int* major, int* minor);
const char* glXGetClientString(void* display, int name);
void* glXGetCurrentDisplay();

GlFunction glXGetProcAddressARB(const unsigned char* name) {
    const char* wanted = reinterpret_cast<const char*>(name);
    // GLEW asks for this one by name too, and OSMesa knows nothing of GLX.
    if (std::strcmp(wanted, "glXGetCurrentDisplay") == 0)
        return reinterpret_cast<GlFunction>(&glXGetCurrentDisplay);
    return OSMesaGetProcAddress(wanted);
}

GlFunction glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }

// GLEW asks for the version of GLX after it has found all of OpenGL; 1.4 is what it was built for.
int glXQueryVersion(void* /*display*/, int* major, int* minor) {
    *major = 1;
    *minor = 4;
    return 1;
}

const char* glXGetClientString(void* /*display*/, int /*name*/) { return ""; }

// There is no display, but GLEW takes a null pointer for a failure; nobody looks behind this one.
void* glXGetCurrentDisplay() {
    static char not_a_display = 0;
    return &not_a_display;
}

}  // extern "C"
