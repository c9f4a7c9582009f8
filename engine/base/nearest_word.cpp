#include "engine/base/nearest_word.hpp"

#include <algorithm>
#include <vector>

namespace spheroscope {

// Edit distance with swaps of neighbours (Damerau 1964), one table row for each letter of `a`.
int count_slips(std::string_view a, std::string_view b) {
    const std::size_t width = b.size() + 1;
    std::vector<int> slips((a.size() + 1) * width);
    for (std::size_t j = 0; j < width; ++j) slips[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        int* const row = slips.data() + i * width;
        const int* const above = row - width;
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int wrong = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + wrong});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], slips[(i - 2) * width + j - 2] + 1);
        }
    }
    return slips.back();
}

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
    std::string nearest;
    int fewest = 0;
    for (const std::string& candidate : candidates) {
        const int slips = count_slips(word, candidate);
        const std::size_t letters = std::max(word.size(), candidate.size());
        const bool near = slips <= static_cast<int>((letters + 2) / 3);
        if (near && (nearest.empty() || slips < fewest)) {
            nearest = candidate;
            fewest = slips;
        }
    }
    return nearest;
}

}  // namespace spheroscope
