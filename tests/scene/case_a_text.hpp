#pragma once

#include <string>

namespace spheroscope {

/// A cell of case A of the paper, in a scene's text, but for its bending.
inline const std::string k_case_a_cell = R"([cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
K = "5 kPa"
[medium]
)";

/// How two of them meet; `law_keys` are lines of [contact].
inline std::string case_a_contact(const std::string& law_keys = "") {
    return "[contact]\n" + law_keys + R"([contact.adhesion]
omega = "0.5 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
)";
}

}  // namespace spheroscope
