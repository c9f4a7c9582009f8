// A target needs a source; this one is for the precompiled headers (cmake/precompiled.cmake).
