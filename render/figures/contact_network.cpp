// Fig. 5: coordination, and the probability of contact forces.
#include "engine/statistics/tail_exponent.hpp"
#include "render/figures/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope::figures {
namespace {

using statistics::SetupStatistics;
using statistics::TailFit;
using statistics::TailScale;

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

/// The fitted law from f = 1 to the largest force, or to where it leaves what densities there are.
reports::Plot::Series fit_line(const TailFit& fit, const std::string& of, double largest,
                               double lowest_density) {
    reports::Plot::Series line{of + " fit", {}, {}};
    line.line = reports::Plot::Line::dashed;
    line.has_marks = false;
    line.colour_of = of;
    for (int i = 0; i <= 40; ++i) {
        const double f = 1.0 + (largest - 1.0) * i / 40.0;
        const double density = fit.a * std::exp(-fit.b * std::pow(f, fit.beta));
        if (density < 0.3 * lowest_density) break;
        line.x.push_back(f);
        line.y.push_back(density);
    }
    return line;
}

void add_threshold_panel(Figure& figure, Setups setups) {
    reports::Plot::Panel panel{"b  Z against the touching threshold",
                               "smallest contact area that counts (µm²)", "Z"};
    panel.y_axis.is_logarithmic = false;
    for (const SetupStatistics& setup : setups) {
        reports::Plot::Series series{setup.label, {}, {}};
        for (const double threshold : statistics::k_touching_thresholds_um2) {
            const statistics::Estimate Z = statistics::over_seeds(
                setup, [&](const auto& run) { return run.coordination_at(threshold); });
            series.x.push_back(threshold);
            series.y.push_back(Z.mean);
            series.error.push_back(Z.standard_error);
            add_row(figure.table, setup,
                    {"b", "coordination_Z", "1", "touching_area_um2", fmt::format("{}", threshold)},
                    Z, k_undefined, 0);
        }
        panel.series.push_back(std::move(series));
    }
    figure.plot.panels.push_back(std::move(panel));
}

/// P(f) with its fit; returns the fits with b = 1, one for each setup.
void add_density_panel(Figure& figure, Setups setups, const std::vector<TailFit>& fits) {
    reports::Plot::Panel panel{"c  probability of contact forces", "f = |F| / <|F|>", "P(f)"};
    panel.x_axis.is_logarithmic = false;
    for (std::size_t s = 0; s < setups.size(); ++s) {
        const SetupStatistics& setup = setups[s];
        const std::vector<double> f = statistics::pooled_forces(setup, statistics::ForceNorm::all);
        reports::Plot::Series series{setup.label, {}, {}};
        series.line = reports::Plot::Line::none;
        if (f.empty()) {
            figure.missing.push_back(
                fmt::format("panel c, {}: no cells touch each other", setup.label));
            panel.series.push_back(std::move(series));
            continue;
        }
        const statistics::Histogram histogram = statistics::doane_histogram(f);
        for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
            add_row(figure.table, setup,
                    {"c", "P_of_f", "1", "f", fmt::format("{:.4f}", histogram.middle(bin))},
                    {histogram.density(bin), histogram.density_error(bin),
                     static_cast<int>(setup.runs.size())},
                    k_undefined, histogram.counts[bin]);
            if (histogram.counts[bin] == 0) continue;
            series.x.push_back(histogram.middle(bin));
            series.y.push_back(histogram.density(bin));
            series.error.push_back(histogram.density_error(bin));
        }
        const double lowest = *std::min_element(series.y.begin(), series.y.end());
        panel.series.push_back(std::move(series));
        if (fits[s].exists())
            panel.series.push_back(
                fit_line(fits[s], setup.label, *std::max_element(f.begin(), f.end()), lowest));
    }
    figure.plot.panels.push_back(std::move(panel));
}

/// ", under the bead"; ", without load"; of some runs each: nothing, the caption has the stages.
std::string load_text(Setups setups) {
    bool is_some_loaded = false, is_some_free = false;
    for (const SetupStatistics& setup : setups)
        for (const statistics::RunStatistics& run : setup.runs)
            (run.load.empty() ? is_some_free : is_some_loaded) = true;
    if (is_some_loaded == is_some_free) return "";
    return is_some_loaded ? ", under the bead" : ", without load";
}

}  // namespace

Figure contact_network(Setups setups) {
    Figure figure;
    figure.table = empty_table();
    figure.plot.columns = 2;
    add_ratio_panel(
        figure, setups, {"a", "coordination_Z", "1", "", ""}, "a  mean number of touching cells",
        "Z", Joined::none, [](const SetupStatistics& setup) {
            return statistics::over_seeds(setup, [](const statistics::RunStatistics& run) {
                return run.coordination_at(run.touching_area_um2);
            });
        });
    add_threshold_panel(figure, setups);
    // Of every setup: b = 1 and free, over all pairs and over those that push.
    std::vector<TailFit> fits;
    for (const SetupStatistics& setup : setups)
        for (const auto norm : {statistics::ForceNorm::all, statistics::ForceNorm::compressive})
            for (const auto scale : {TailScale::one, TailScale::free}) {
                const TailFit fit =
                    statistics::fit_tail(statistics::pooled_forces(setup, norm), scale);
                const std::string name =
                    fmt::format("beta{}{}", scale == TailScale::one ? "_b_1" : "_b_free",
                                norm == statistics::ForceNorm::all ? "" : "_compressive_pairs");
                add_row(figure.table, setup,
                        {"d", name, "1", "Et_over_omega",
                         statistics::ratio_text(setup.setup().Et_over_omega)},
                        {fit.exists() ? fit.beta : k_undefined,
                         fit.exists() ? fit.beta_error : k_undefined,
                         static_cast<int>(setup.runs.size())},
                        k_undefined, fit.n_forces);
                if (const std::string gap = fit.gap(); !gap.empty())
                    figure.missing.push_back(fmt::format("{}, {}: {}", setup.label, name, gap));
                if (norm == statistics::ForceNorm::all && scale == TailScale::one)
                    fits.push_back(fit);
            }
    add_density_panel(figure, setups, fits);
    // The rows of panel d are there already; the panel has those with b = 1.
    Figure panel_d;
    add_ratio_panel(panel_d, setups, {"d", "beta", "1", "", ""},
                    "d  exponent of P(f) ~ exp(−fᵝ), f > 1", "β", Joined::none,
                    [&](const SetupStatistics& setup) -> statistics::Estimate {
                        const TailFit& fit = fits[static_cast<std::size_t>(&setup - setups.data())];
                        if (!fit.exists()) return {};
                        return {fit.beta, fit.beta_error, static_cast<int>(setup.runs.size())};
                    });
    figure.plot.panels.push_back(panel_d.plot.panels.front());
    finish(figure, setups, "Fig. 5: contact network" + load_text(setups));
    figure.plot.caption.emplace_back(
        "c: Doane's bins over the touching pairs of all seeds, f over each run's mean; bars: "
        "counting error; dashed: fit of a exp(−fᵝ). d: bars: bootstrap.");
    return figure;
}

}  // namespace spheroscope::figures
