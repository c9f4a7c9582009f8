#include "engine/solve/explicit_bound.hpp"

#include <cstdio>

namespace spheroscope {

Trouble ExplicitBound::too_large(System& system, double dt_s, double stable_dt_s, const Loc& loc) {
    Trouble trouble = mode_.place(system);
    char text[160];
    std::snprintf(text, sizeof text,
                  "unstable: the step of %.4g ms is above the largest stable one, %.4g ms,"
                  " which comes",
                  1e3 * dt_s, 1e3 * stable_dt_s);
    trouble.what = text;
    trouble.loc = loc;
    return trouble;
}

}  // namespace spheroscope
