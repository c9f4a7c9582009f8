#pragma once

#include <string>
#include <vector>

namespace spheroscope::structure {

/// One broken rule: "engine/forces/bending.hpp:3: forces may not include solve (engine/solve/...)".
using Violation = std::string;

/// Which includes of a source file break the dependency rule.
/// `path` is relative to the root of the sources ("engine/forces/bending.hpp"), `text` its content.
/// Files outside engine/ and render/ have no rule.
[[nodiscard]] std::vector<Violation> find_violations(const std::string& path,
                                                     const std::string& text);

}  // namespace spheroscope::structure
