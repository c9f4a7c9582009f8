#pragma once

#include <string>
#include <string_view>

namespace spheroscope {

/// A text as it stands between two tags or in quotation marks of XML.
[[nodiscard]] std::string escape_xml(std::string_view text);

}  // namespace spheroscope
