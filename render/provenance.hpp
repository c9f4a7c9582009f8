#pragma once

#include "render/picture.hpp"
#include "render/png.hpp"

#include <string>
#include <vector>

namespace spheroscope::render {

/// Key of the fingerprint among the texts of a picture's file.
inline constexpr const char* k_fingerprint_key = "Fingerprint";

/// Key of the description from which the picture can be drawn again.
inline constexpr const char* k_view_key = "View";

/// Key of what had been changed during the run by then (changes_text), if anything had.
inline constexpr const char* k_changes_key = "Changes";

/// That text for a frame; empty: nothing had been changed in the motion.
[[nodiscard]] std::string changes_until(const Snapshot& snapshot);

/// What a picture is drawn with besides the frame.
struct Description {
    scene::Picture picture;
    View view;
};
/// As one line of JSON; parse_description gives back the same numbers to the last bit.
[[nodiscard]] std::string description_text(const scene::Picture& picture, const View& view);
/// Throws Error (usage) for a text that is no such description.
[[nodiscard]] Description parse_description(const std::string& text);

/// Everything that a reader of the file may ask: title, scene, seed, frame, time, field, range,
/// versions, fingerprint. drawn_by: version of the program that draws.
[[nodiscard]] PngTexts make_provenance(const Snapshot& snapshot, const scene::Picture& picture,
                                       const View& view, const std::string& drawn_by);

/// A number (16 hexadecimal digits) of everything that the pixels depend on: frame, view, settings,
/// version. Equal fingerprints: equal pictures. (A 64-bit check sum against mix-ups, not against
/// forgery.)
[[nodiscard]] std::string make_fingerprint(const Snapshot& snapshot, const scene::Picture& picture,
                                           const View& view, const std::string& drawn_by);

/// The fingerprint of a picture that is made of several parts: of theirs, in order.
[[nodiscard]] std::string join_fingerprints(const std::vector<std::string>& parts);

}  // namespace spheroscope::render
