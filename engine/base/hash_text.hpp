#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace spheroscope {

/// "0123456789abcdef"
[[nodiscard]] std::string hash_text(std::uint64_t hash);
/// None for anything but 16 hexadecimal digits.
[[nodiscard]] std::optional<std::uint64_t> hash_of_text(std::string_view text);

}  // namespace spheroscope
