#include "render/figures/parts.hpp"

#include "engine/base/counted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace spheroscope::figures {
namespace {

reports::TableCell cell_of(double value) {
    if (!std::isfinite(value)) return reports::Missing{"-"};
    return value;
}

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

reports::ReportTable empty_table() {
    reports::ReportTable table;
    table.columns = {{"panel"},
                     {"quantity"},
                     {"unit"},
                     {"setup"},
                     {"gamma_over_omega"},
                     {"Et_over_omega"},
                     {"N"},
                     {"nodes"},
                     {"law"},
                     {"omega_reading"},
                     {"x_name"},
                     {"x"},
                     {"mean"},
                     {"standard_error"},
                     {"spread"},
                     {"seeds"},
                     {"n"}};
    return table;
}

void add_row(reports::ReportTable& table, const statistics::SetupStatistics& setup,
             const Place& place, const statistics::Estimate& value, double spread, int n) {
    const statistics::Setup& s = setup.setup();
    table.rows.push_back(
        {place.panel, place.quantity, place.unit, setup.label, cell_of(s.gamma_over_omega),
         cell_of(s.Et_over_omega), std::int64_t{s.n_cells}, std::int64_t{s.n_nodes}, s.law,
         s.omega_reading, place.x_name, place.x, cell_of(value.mean), cell_of(value.standard_error),
         cell_of(spread), std::int64_t{value.n},
         n > 0 ? reports::TableCell(std::int64_t{n}) : reports::TableCell(reports::Missing{"-"})});
}

void add_profile_panel(Figure& figure, Setups setups, const Place& place, const std::string& title,
                       const std::string& y_title, double scale, SamplesOf samples,
                       std::size_t number) {
    reports::Plot::Panel panel{title, "r / R_th", y_title};
    panel.x_axis.is_logarithmic = panel.y_axis.is_logarithmic = false;
    for (const statistics::SetupStatistics& setup : setups) {
        std::vector<std::vector<statistics::ProbeSample>> replicates;
        for (const statistics::RunStatistics& run : setup.runs)
            replicates.push_back(samples(run, number));
        reports::Plot::Series series{setup.label, {}, {}};
        for (const statistics::ProfilePoint& point : statistics::pooled_profile(replicates)) {
            series.x.push_back(point.r);
            series.y.push_back(scale * point.mean);
            series.error.push_back(scale * point.standard_error);
            Place here = place;
            here.x_name = "r_over_R_th";
            here.x = fmt::format("{:.3f}", point.r);
            add_row(figure.table, setup, here,
                    {scale * point.mean, scale * point.standard_error, point.n_replicates},
                    scale * point.spread, point.n_probes);
        }
        if (series.x.empty())
            figure.missing.push_back(
                fmt::format("panel {}, {}: no probe has a value", place.panel, setup.label));
        panel.series.push_back(std::move(series));
    }
    figure.plot.panels.push_back(std::move(panel));
}

namespace {

/// E t / omega comes from a division: 0.75 has several values.
bool is_same_ratio(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

/// Those of the setups, ascending.
std::vector<double> different_ratios(Setups setups) {
    std::vector<double> ratios;
    for (const statistics::SetupStatistics& setup : setups)
        if (std::isfinite(setup.setup().Et_over_omega))
            ratios.push_back(setup.setup().Et_over_omega);
    std::sort(ratios.begin(), ratios.end());
    ratios.erase(std::unique(ratios.begin(), ratios.end(), is_same_ratio), ratios.end());
    return ratios;
}

/// How far from the middle of its category a setup stands: those of one ratio side by side, so that
/// no error bar hides another one.
double beside(Setups setups, const statistics::SetupStatistics& setup) {
    int n = 0, number = 0;
    for (const statistics::SetupStatistics& other : setups) {
        if (!is_same_ratio(other.setup().Et_over_omega, setup.setup().Et_over_omega)) continue;
        if (&other == &setup) number = n;
        ++n;
    }
    constexpr double k_most = 0.4, k_apart = 0.1;  // of the distance of categories
    return (number - 0.5 * (n - 1)) * std::min(k_apart, k_most / n);
}

}  // namespace

void add_ratio_panel(Figure& figure, Setups setups, const Place& place, const std::string& title,
                     const std::string& y_title, Joined joined, const EstimateOf& estimate) {
    reports::Plot::Panel panel{title, "Et/ω", y_title};
    panel.y_axis.is_logarithmic = false;
    const std::vector<double> ratios = different_ratios(setups);
    for (const double ratio : ratios)
        panel.x_axis.categories.push_back(statistics::ratio_text(ratio));
    std::map<std::string, std::size_t> series_of;
    for (const statistics::SetupStatistics& setup : setups) {
        const statistics::Estimate value = estimate(setup);
        Place here = place;
        here.x_name = "Et_over_omega";
        here.x = statistics::ratio_text(setup.setup().Et_over_omega);
        add_row(figure.table, setup, here, value, k_undefined, 0);
        const auto ratio = std::find_if(ratios.begin(), ratios.end(), [&](double r) {
            return is_same_ratio(r, setup.setup().Et_over_omega);
        });
        if (!std::isfinite(value.mean) || ratio == ratios.end()) {
            figure.missing.push_back(fmt::format("panel {}, {}: {} is undefined", place.panel,
                                                 setup.label,
                                                 ratio == ratios.end() ? "Et/ω" : place.quantity));
            continue;
        }
        const std::string& name = joined == Joined::families ? setup.family : setup.label;
        const auto [at, is_new] = series_of.emplace(name, panel.series.size());
        if (is_new) panel.series.push_back({name, {}, {}});
        reports::Plot::Series& series = panel.series[at->second];
        double x = static_cast<double>(std::distance(ratios.begin(), ratio));
        if (joined == Joined::none) {
            series.line = reports::Plot::Line::none;
            x += beside(setups, setup);
        }
        series.x.push_back(x);
        series.y.push_back(value.mean);
        series.error.push_back(value.standard_error);
    }
    figure.plot.panels.push_back(std::move(panel));
}

std::vector<reports::Plot::Band> experimental_bands(std::size_t row) {
    switch (row) {
    case 0: return {{-358.0, -358.0, "−358 Pa: Mohagheghian 2018"}};
    case 1: return {{49.0, 49.0, "49 Pa: Mohagheghian 2018"}};
    case 2: return {{1500.0, 3600.0, "1.5–3.6 kPa: Campàs 2014"}};
    case 3: return {{200.0, 350.0, "200–350 Pa: Lucio 2017"}};
    default: return {};
    }
}

std::string stress_title(std::size_t row) {
    return std::string(statistics::all_cell_stresses()[row].label) + " (Pa)";
}

void finish(Figure& figure, Setups setups, const std::string& title) {
    figure.plot.title = title;
    figure.plot.legend_above = true;
    int n_runs = 0;
    std::size_t fewest = std::numeric_limits<std::size_t>::max(), most = 0;
    std::set<std::string> stages;
    bool have_all_ended = true;
    for (const statistics::SetupStatistics& setup : setups) {
        n_runs += static_cast<int>(setup.runs.size());
        fewest = std::min(fewest, setup.runs.size());
        most = std::max(most, setup.runs.size());
        for (const statistics::RunStatistics& run : setup.runs) {
            stages.insert(run.stage_name);
            have_all_ended = have_all_ended && run.has_ended();
        }
    }
    std::string errors;
    if (std::any_of(figure.plot.panels.begin(), figure.plot.panels.end(),
                    [](const reports::Plot::Panel& panel) { return !panel.series.empty(); }))
        errors = most < 2 ? " One seed each: no error bars."
                          : " Error bars: standard error over seeds, where larger than the mark.";
    if (most > 1 && fewest < 2) errors += " One seed has none.";
    figure.plot.caption.push_back(fmt::format(
        "{} of {} {} {} {} (stage: {}).{}", counted(n_runs, "run"), counted(setups.size(), "setup"),
        have_all_ended ? "at" : "in", n_runs == 1 ? "its" : "their",
        have_all_ended ? "end" : "last frame", fmt::join(stages, ", "), errors));
}

}  // namespace spheroscope::figures
