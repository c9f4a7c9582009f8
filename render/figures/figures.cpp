#include "render/figures/figure.hpp"

#include <array>

namespace spheroscope::figures {

std::span<const FigureRow> all_figures() {
    static constexpr std::array<FigureRow, 6> rows{{
        {"fig2", "radial profiles of stress and pores, tension by region", radial_profiles},
        {"fig3", "stress of cells from the middle outward, with experiments", stress_profiles},
        {"fig4", "stress of cells, mean over all cells", stress_statistics},
        {"fig5", "coordination, and the probability of contact forces", contact_network},
        {"force_displacement", "force of bead and hull over the bead's way", force_displacement},
        {"fig7", "maps over gamma/omega and Et/omega", parameter_maps},
    }};
    return rows;
}

}  // namespace spheroscope::figures
