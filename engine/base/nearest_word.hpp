#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spheroscope {

/// How many typing slips (a letter too many, too few, wrong, or two neighbours swapped) lead from
/// `a` to `b`. Compares bytes.
[[nodiscard]] int count_slips(std::string_view a, std::string_view b);

/// The candidate with the fewest slips from `word`, the first one of equals; "" when none is near
/// enough to have been meant, that is, within a third of the letters of the longer word, rounded
/// up.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       std::span<const std::string> candidates);

}  // namespace spheroscope
