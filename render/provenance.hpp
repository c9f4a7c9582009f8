#pragma once

#include "render/picture.hpp"
#include "render/png.hpp"

#include <string>

namespace spheroscope::render {

/// Key of the fingerprint among the texts of a picture's file.
inline constexpr const char* k_fingerprint_key = "Fingerprint";

/// Everything that a reader of the file may ask: title, scene, seed, frame, time, field, range,
/// versions, fingerprint. drawn_by: version of the program that draws.
[[nodiscard]] PngTexts make_provenance(const Snapshot& snapshot, const scene::Picture& picture,
                                       const View& view, const std::string& drawn_by);

/// A number (16 hexadecimal digits) of everything that the pixels depend on: frame, view, settings,
/// version. Equal fingerprints: equal pictures. (A 64-bit check sum against mix-ups, not against
/// forgery.)
[[nodiscard]] std::string make_fingerprint(const Snapshot& snapshot, const scene::Picture& picture,
                                           const View& view, const std::string& drawn_by);

}  // namespace spheroscope::render
