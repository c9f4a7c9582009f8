// Fig. 3: the stress of single cells from the middle outward, beside what was measured in tissues.
#include "render/figures/parts.hpp"

#include <fmt/format.h>

namespace spheroscope::figures {

Figure stress_profiles(Setups setups) {
    Figure figure;
    figure.table = empty_table();
    figure.plot.columns = 2;
    const auto rows = statistics::all_cell_stresses();
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const std::string panel(1, static_cast<char>('a' + r));
        add_profile_panel(
            figure, setups, {panel, std::string(rows[r].quantity), "Pa", "", ""},
            fmt::format("{}  {}", panel, rows[r].label), stress_title(r), k_Pa_per_kPa,
            [](const statistics::RunStatistics& run, std::size_t number) -> const auto& {
                return run.cell_stress_kPa[number];
            },
            r);
        figure.plot.panels.back().bands = experimental_bands(r);
        // the experiment's mean normal stress is ten times ours
        figure.plot.panels.back().y_axis.breaks_before_bands = r == 0;
    }
    finish(figure, setups, "Fig. 3: stress of cells from the middle outward");
    figure.plot.caption.emplace_back(
        "Of each cell's touching triangles, each counted once. Tinted: experiments. Max. "
        "anisotropic: P95 − P5; mean anisotropic: standard deviation.");
    return figure;
}

}  // namespace spheroscope::figures
