#pragma once

#include "engine/inspect/contact_report.hpp"
#include "engine/run/step_anatomy.hpp"

#include <optional>
#include <string>
#include <variant>

namespace spheroscope::viewer {

/// What can be shown, taken apart, in place of all cells: a contact, or the forces on a node.
using Opened = std::variant<inspect::ContactKey, NodeOfCell>;

/// "17-42", "17:203": as `inspect` takes them.
[[nodiscard]] std::string key_text(const Opened& opened);
/// "contact 17-42", "node 17:203"
[[nodiscard]] std::string text_of(const Opened& opened);
[[nodiscard]] std::optional<inspect::ContactKey> contact_of(const std::optional<Opened>& opened);

}  // namespace spheroscope::viewer
