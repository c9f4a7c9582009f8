#include "engine/solve/forward_euler.hpp"
#include "engine/solve/linearly_implicit.hpp"
#include "engine/solve/method.hpp"

#include <array>

namespace spheroscope {

std::span<const MethodRow> all_methods() {
    static constexpr std::array<MethodRow, 2> rows{{
        {"forward_euler", 1, false, false, "the paper's method: explicit, fixed step",
         make_forward_euler},
        {"linearly_implicit", 1, true, true,
         "(Gamma + dt K) v = F with an adaptive step: the work-horse", make_linearly_implicit},
    }};
    return rows;
}

const MethodRow* find_method(std::string_view name) {
    for (const MethodRow& row : all_methods())
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace spheroscope
