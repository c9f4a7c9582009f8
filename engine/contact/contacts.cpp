#include "engine/contact/contacts.hpp"

namespace spheroscope {

void Contacts::index_sides(int n_cells) {
    cell_begin.assign(static_cast<std::size_t>(n_cells) + 1, 0);
    for (const Group& group : groups) {
        ++cell_begin[static_cast<std::size_t>(group.cell_a) + 1];
        ++cell_begin[static_cast<std::size_t>(group.cell_b) + 1];
    }
    for (std::size_t c = 1; c < cell_begin.size(); ++c) cell_begin[c] += cell_begin[c - 1];
    cell_sides.resize(2 * groups.size());
    std::vector<int> next(cell_begin.begin(), cell_begin.end() - 1);
    for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
        const Group& group = groups[static_cast<std::size_t>(g)];
        const auto place = [&](int cell, bool is_a) {
            int& position = next[static_cast<std::size_t>(cell)];
            cell_sides[static_cast<std::size_t>(position++)] = {g, is_a};
        };
        place(group.cell_a, true);
        place(group.cell_b, false);
    }
}

}  // namespace spheroscope
