// Fig. 4: means over all cells of the stress of cells, against the stiffness of their cortex.
#include "render/figures/parts.hpp"

#include <fmt/format.h>

#include <limits>

namespace spheroscope::figures {

Figure stress_statistics(Setups setups) {
    using statistics::Weighting;
    Figure figure;
    figure.table = empty_table();
    figure.plot.columns = 2;
    const auto rows = statistics::all_cell_stresses();
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const std::string panel(1, static_cast<char>('a' + r));
        const auto estimate = [&](Weighting weighting) -> EstimateOf {
            return [&rows, r, weighting](const statistics::SetupStatistics& setup) {
                return statistics::over_seeds(setup, [&](const statistics::RunStatistics& run) {
                    return k_Pa_per_kPa * run.mean_stress_kPa(rows[r], weighting);
                });
            };
        };
        const std::string quantity(rows[r].quantity);
        add_ratio_panel(figure, setups, {panel, quantity, "Pa", "", ""},
                        fmt::format("{}  {}", panel, rows[r].label), stress_title(r),
                        Joined::families, estimate(Weighting::equal));
        figure.plot.panels.back().bands = experimental_bands(r);
        // the experiment's mean normal stress is ten times ours
        figure.plot.panels.back().y_axis.breaks_before_bands = r == 0;
        for (const statistics::SetupStatistics& setup : setups)
            add_row(figure.table, setup,
                    {panel, quantity + "_area_weighted", "Pa", "Et_over_omega",
                     statistics::ratio_text(setup.setup().Et_over_omega)},
                    estimate(Weighting::area)(setup), std::numeric_limits<double>::quiet_NaN(), 0);
    }
    finish(figure, setups, "Fig. 4: stress of cells, mean over all cells");
    figure.plot.caption.emplace_back(
        "Of each cell's touching triangles, each counted once; the CSV has the same weighted with "
        "their areas. Tinted: experiments.");
    return figure;
}

}  // namespace spheroscope::figures
