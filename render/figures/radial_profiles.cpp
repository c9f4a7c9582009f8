// Fig. 2: hydrostatic stress, pores and elastic tension from the middle of the aggregates outward.
#include "render/figures/parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace spheroscope::figures {
namespace {

void add_tension_panel(Figure& figure, Setups setups) {
    reports::Plot::Panel panel{"d  elastic tension by region", "", "γᵉᶠᶠ (mN/m)"};
    panel.y_axis.is_logarithmic = false;
    for (const statistics::Region region : statistics::k_regions)
        panel.x_axis.categories.emplace_back(name_of(region));
    for (const statistics::SetupStatistics& setup : setups) {
        reports::Plot::Series series{setup.label, {}, {}};
        series.line = reports::Plot::Line::none;
        for (std::size_t r = 0; r < statistics::k_regions.size(); ++r) {
            const statistics::Estimate value = statistics::over_seeds(
                setup, [&](const auto& run) { return run.tension_nN_per_um[r]; });
            const std::string name(name_of(statistics::k_regions[r]));
            add_row(figure.table, setup, {"d", "gamma_eff", "mN/m", "region", name}, value,
                    std::numeric_limits<double>::quiet_NaN(), 0);
            if (!std::isfinite(value.mean)) {
                figure.missing.push_back(
                    fmt::format("panel d, {}: no node in the region '{}'", setup.label, name));
                continue;
            }
            series.x.push_back(static_cast<double>(r));
            series.y.push_back(value.mean);
            series.error.push_back(value.standard_error);
        }
        panel.series.push_back(std::move(series));
    }
    figure.plot.panels.push_back(std::move(panel));
}

}  // namespace

Figure radial_profiles(Setups setups) {
    using Run = statistics::RunStatistics;
    Figure figure;
    figure.table = empty_table();
    figure.plot.columns = 2;
    add_profile_panel(
        figure, setups, {"a", "sigma_h_nearest_cell", "Pa", "", ""},
        "a  hydrostatic stress, nearest cell", "σʰ (Pa)", k_Pa_per_kPa,
        [](const Run& run, std::size_t) -> const auto& { return run.sigma_h_nearest_kPa; });
    add_profile_panel(
        figure, setups, {"b", "sigma_h_inverse_distance", "Pa", "", ""},
        "b  hydrostatic stress, inverse distance", "σʰ (Pa)", k_Pa_per_kPa,
        [](const Run& run, std::size_t) -> const auto& { return run.sigma_h_smooth_kPa; });
    add_profile_panel(
        figure, setups, {"c", "void_fraction", "1", "", ""}, "c  void fraction",
        "share of probes in no cell", 1.0,
        [](const Run& run, std::size_t) -> const auto& { return run.voids; });
    add_tension_panel(figure, setups);
    finish(figure, setups, "Fig. 2: stress, pores and tension from the middle outward");
    figure.plot.caption.emplace_back(
        "10 000 random probes within R_th, the radius of the sphere with the volume of all cells; "
        "tension positive.");
    return figure;
}

}  // namespace spheroscope::figures
