#pragma once

#include "engine/base/error.hpp"
#include "engine/scene/scene.hpp"

#include <string>

namespace spheroscope::scene {

/// A lone drop: the smallest scene that is complete.
inline const std::string k_drop = R"([cells]
arrangement = "single"
radius = "9 um"

[cortex.tension]
gamma = "0.5 nN/um"

[medium]

[[stage]]
kind = "relax"
duration = "1 s"
)";

/// Two cells with every part of the model.
inline const std::string k_doublet = R"([cells]
arrangement = "pair"
radius = "9 um"

[cortex.elastic]
E = "20 kPa"

[cortex.bending]

[cortex.tension]
gamma = "0.5 nN/um"

[cortex.viscosity]
eta = "1 kPa s"

[cytosol]

[medium]

[contact]

[contact.adhesion]
omega = "0.5 nN/um"

[[stage]]
kind = "relax"
duration = "1 s"
)";

/// The text with one part replaced by another; the part must be there.
inline std::string with(std::string text, const std::string& part, const std::string& other) {
    const auto at = text.find(part);
    SPHEROSCOPE_ASSERT(at != std::string::npos, part);
    return text.replace(at, part.size(), other);
}

/// The complete message that the scene is refused with; "accepted" if it is not.
inline std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
    try {
        static_cast<void>(parse_scene(text, "a.toml", overrides));
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace spheroscope::scene
