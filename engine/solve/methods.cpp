#include "engine/solve/equilibrium.hpp"
#include "engine/solve/forward_euler.hpp"
#include "engine/solve/linearly_implicit.hpp"
#include "engine/solve/method.hpp"
#include "engine/solve/rkc.hpp"
#include "engine/solve/rosenbrock_w.hpp"

#include <array>

namespace spheroscope {

std::span<const MethodRow> all_methods() {
    // Columns: name, order, order of the estimate, stages, needs stiffness, holds exact volume,
    // moves probe.
    static constexpr std::array<MethodRow, 5> rows{{
        {"forward_euler", 1, 0, 1, false, false, false, "the paper's method: explicit, fixed step",
         make_forward_euler},
        {"linearly_implicit", 1, 2, 1, true, true, true,
         "(Gamma + dt K) v = F with an adaptive step: the work-horse", make_linearly_implicit},
        {"rosenbrock_w", 2, 2, 2, true, false, false,
         "two linearly implicit stages, second order, for accuracy in time", make_rosenbrock_w},
        {"rkc", 2, 3, 0, false, false, false,
         "explicit Runge-Kutta-Chebyshev, second order, as many stages as stability asks for",
         make_rkc},
        {"equilibrium", 0, 2, 1, true, true, true,
         "end states only: linearly implicit steps that grow without regard to the time in between",
         make_equilibrium},
    }};
    return rows;
}

const MethodRow* find_method(std::string_view name) {
    for (const MethodRow& row : all_methods())
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace spheroscope
