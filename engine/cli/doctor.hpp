#pragma once

#include "engine/cli/verb.hpp"

#include <functional>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// Draws something, reads it back, and says what drew it. Throws Error with the reason if that
/// fails.
using PictureProbe = std::function<std::string()>;

/// `doctor`. probe: empty in a program without pictures.
[[nodiscard]] Verb doctor_verb(const PictureProbe& probe);

/// One thing that the program can use.
struct Finding {
    std::string name;        ///< "opengl"
    bool is_there = false;   ///< and works
    bool is_needed = false;  ///< by a verb of this program; `doctor` fails without it
    std::string text;        ///< what was found, or what is wrong and what to do
};

/// Whether an X server answers at DISPLAY (`display`: its value, "" if unset), and whether
/// there is an Xvfb to start one. Never needed.
[[nodiscard]] Finding find_display(const std::string& display, bool has_wayland, bool has_xvfb);

}  // namespace spheroscope::cli
