// Appendix G: forces of bead and hull on the cells over the bead's way, a line for each run.
#include "render/figures/parts.hpp"

#include <fmt/format.h>

#include <limits>
#include <tuple>

namespace spheroscope::figures {

Figure force_displacement(Setups setups) {
    Figure figure;
    figure.table = empty_table();
    reports::Plot::Panel panel{"bead, one line a seed; dashed: hull", "way of the bead (µm)",
                               "force (nN)"};
    panel.x_axis.is_logarithmic = panel.y_axis.is_logarithmic = false;
    for (const statistics::SetupStatistics& setup : setups) {
        bool is_in_legend = false;
        for (const statistics::RunStatistics& run : setup.runs) {
            if (run.load.empty()) {
                figure.missing.push_back(
                    run.file + (run.n_undefined_loads > 0
                                    ? ": force or way of the bead is undefined in all frames"
                                    : ": it has no frames of a stage of kind indent"));
                continue;
            }
            reports::Plot::Series bead{setup.label, {}, {}}, hull{setup.label, {}, {}};
            hull.line = reports::Plot::Line::dashed;
            bead.has_marks = hull.has_marks = false;
            hull.colour_of = setup.label;
            if (is_in_legend) bead.colour_of = setup.label;
            is_in_legend = true;
            for (const statistics::LoadPoint& point : run.load) {
                for (const auto& [series, force_nN, quantity] :
                     {std::tuple{&bead, point.probe_nN, "probe_force"},
                      std::tuple{&hull, point.hull_nN, "hull_force"}}) {
                    series->x.push_back(point.way_um);
                    series->y.push_back(force_nN);
                    add_row(figure.table, setup,
                            {fmt::format("seed {}", run.seed), quantity, "nN", "way_um",
                             fmt::format("{:.6g}", point.way_um)},
                            {force_nN, std::numeric_limits<double>::quiet_NaN(), 1},
                            std::numeric_limits<double>::quiet_NaN(), 0);
                }
            }
            panel.series.push_back(std::move(bead));
            panel.series.push_back(std::move(hull));
        }
    }
    if (panel.series.empty()) return figure;
    figure.plot.panels.push_back(std::move(panel));
    finish(figure, setups, "Loading: force against displacement");
    figure.plot.columns = 1;
    return figure;
}

}  // namespace spheroscope::figures
