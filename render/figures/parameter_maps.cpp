// Fig. 7: measures over gamma/omega and Et/omega, on the paper's broad grid and on its refined one.
#include "engine/base/counted.hpp"
#include "render/figures/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace spheroscope::figures {
namespace {

using statistics::SetupStatistics;

struct Grid {
    std::string name;
    std::vector<double> gamma_over_omega, Et_over_omega;
};
const std::array k_grids{
    Grid{"broad grid", {0.5, 1, 2, 4, 8}, {0.125, 0.5, 2, 8, 32, 64}},
    Grid{"refined grid", {0.5, 0.625, 0.75, 0.875, 1}, {0.125, 0.25, 0.5, 0.75, 1}},
};

struct Quantity {
    std::string_view total;  ///< a row of all_totals()
    std::string label;
};
const std::array k_quantities{Quantity{"eps_YL_omega", "defect ε, norm 2ω/R"},
                              Quantity{"eps_YL_W", "defect ε, norm W/R"},
                              Quantity{"coordination_Z", "Z"}};

bool is_equal(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); }

const SetupStatistics* find(Setups setups, double gamma_over_omega, double Et_over_omega) {
    for (const SetupStatistics& setup : setups)
        if (is_equal(setup.setup().gamma_over_omega, gamma_over_omega) &&
            is_equal(setup.setup().Et_over_omega, Et_over_omega))
            return &setup;
    return nullptr;
}

statistics::Estimate estimate_of(const SetupStatistics& setup, const Quantity& quantity) {
    const TotalsRow& row = *find_total(quantity.total);
    return statistics::over_seeds(
        setup, [&](const statistics::RunStatistics& run) { return value_of(row, run.totals); });
}

bool has(const std::vector<double>& values, double value) {
    return std::any_of(values.begin(), values.end(), [&](double v) { return is_equal(value, v); });
}

bool is_on(const Grid& grid, const statistics::Setup& setup) {
    return has(grid.gamma_over_omega, setup.gamma_over_omega) &&
           has(grid.Et_over_omega, setup.Et_over_omega);
}

int points_on(const Grid& grid, Setups setups) {
    int n = 0;
    for (const double gamma : grid.gamma_over_omega)
        for (const double Et : grid.Et_over_omega) n += find(setups, gamma, Et) != nullptr ? 1 : 0;
    return n;
}

/// Whether every point of `grid` that the setups have is on `other`, which shows more of them, or
/// as many and comes first.
bool is_covered(const Grid& grid, const Grid& other, Setups setups) {
    const int n = points_on(grid, setups), n_other = points_on(other, setups);
    if (n > n_other || (n == n_other && &grid <= &other)) return false;
    return std::none_of(setups.begin(), setups.end(), [&](const SetupStatistics& setup) {
        return is_on(grid, setup.setup()) && !is_on(other, setup.setup());
    });
}

/// Those of the paper's grids that show the setups, in the paper's order. The grids share points:
/// one whose points are all on another one is left out.
std::vector<Grid> grids_of(Setups setups) {
    std::vector<Grid> drawn;
    for (const Grid& grid : k_grids)
        if (points_on(grid, setups) > 1 &&
            std::none_of(k_grids.begin(), k_grids.end(),
                         [&](const Grid& other) { return is_covered(grid, other, setups); }))
            drawn.push_back(grid);
    return drawn;
}

/// Below this share of its cell's mean a triangle counts as collapsed, as in [expect] of the
/// paper's scenes.
constexpr double k_collapsed = 0.3;

int collapsed_seeds(const SetupStatistics& setup) {
    return static_cast<int>(std::count_if(
        setup.runs.begin(), setup.runs.end(), [](const statistics::RunStatistics& run) {
            return run.totals.smallest_triangle < k_collapsed || run.totals.n_flipped_triangles > 0;
        }));
}

/// What a reader has to know of one point: outside of the paper's ranges, shaped by the strain
/// limiter, with collapsed triangles.
std::string marks_of(Setups setups, const SetupStatistics* setup, double gamma, double Et) {
    std::string marks;
    if (!setups.front().setup().is_in_table_2(gamma, Et)) marks += "†";
    if (setup != nullptr && setup->setup().limiter_nN_per_um > 0.0) marks += "‡";
    if (setup != nullptr && collapsed_seeds(*setup) > 0) marks += "×";
    return marks;
}

/// The mean, down to the first digit of its error; three digits without one.
std::string text_of(const statistics::Estimate& e) {
    if (!(e.standard_error > 0.0)) return fmt::format("{:.3g}", e.mean);
    const int decimals = static_cast<int>(-std::floor(std::log10(e.standard_error)));
    return fmt::format("{:.{}f}", e.mean, std::clamp(decimals, 0, 4));
}

reports::Plot::Map map_of(Figure& figure, Setups setups, const Grid& grid, const Quantity& quantity,
                          const std::string& panel) {
    reports::Plot::Map map;
    map.title = quantity.label;
    for (const double Et : grid.Et_over_omega) map.x_labels.push_back(statistics::ratio_text(Et));
    for (const double gamma : grid.gamma_over_omega) {
        map.y_labels.push_back(statistics::ratio_text(gamma));
        for (const double Et : grid.Et_over_omega) {
            reports::Plot::Map::Value value{std::numeric_limits<double>::quiet_NaN(), "", ""};
            const SetupStatistics* const setup = find(setups, gamma, Et);
            if (setup != nullptr) {
                const statistics::Estimate e = estimate_of(*setup, quantity);
                value.value = e.mean;
                value.text = text_of(e);
                if (std::isfinite(e.standard_error))
                    value.mark = fmt::format("±{:.1g}", e.standard_error);
                add_row(figure.table, *setup,
                        {panel, std::string(quantity.total), "1", "grid", grid.name}, e,
                        std::numeric_limits<double>::quiet_NaN(), 0);
                if (!std::isfinite(e.mean))
                    figure.missing.push_back(fmt::format("panel {}, {}: {} is undefined", panel,
                                                         setup->label, quantity.total));
            }
            value.mark += marks_of(setups, setup, gamma, Et);  // a field has room for no space
            map.values.push_back(std::move(value));
        }
    }
    return map;
}

/// One range for all maps of a quantity: its ends rounded outward to tenths of a decade.
void set_common_range(std::vector<reports::Plot::Map*> maps) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const reports::Plot::Map* map : maps)
        for (const auto& value : map->values)
            if (std::isfinite(value.value)) {
                low = std::min(low, value.value);
                high = std::max(high, value.value);
            }
    if (low > high) {
        low = 0.0;
        high = 1.0;
    }
    const double span = std::max(high - low, 0.02 * std::max(1.0, std::abs(high)));
    const double step = std::pow(10.0, std::floor(std::log10(span)));
    for (reports::Plot::Map* map : maps) {
        map->low = std::floor(low / step + 1e-9) * step;
        map->high = std::max(std::ceil(high / step - 1e-9) * step, map->low + step);
    }
}

/// Why these setups make no map; "" if they do.
std::string objection(Setups setups) {
    std::set<double> gamma, Et;
    std::set<std::string> others;
    for (const SetupStatistics& setup : setups) {
        const statistics::Setup& s = setup.setup();
        if (std::isfinite(s.gamma_over_omega)) gamma.insert(s.gamma_over_omega);
        if (std::isfinite(s.Et_over_omega)) Et.insert(s.Et_over_omega);
        others.insert(
            fmt::format("N = {}, {} nodes, {}, {}", s.n_cells, s.n_nodes, s.law, s.omega_reading));
    }
    if (gamma.size() < 2 || Et.size() < 2)
        return fmt::format("the runs have {} of γ/ω and {} of Et/ω: a map wants two of each",
                           counted(gamma.size(), "value"), Et.size());
    if (others.size() > 1)
        return fmt::format("the runs differ in more than γ/ω and Et/ω ({}): give those of one map",
                           fmt::join(others, "; "));
    return "";
}

}  // namespace

Figure parameter_maps(Setups setups) {
    Figure figure;
    figure.table = empty_table();
    std::string reason = objection(setups);
    std::vector<Grid> grids;
    if (reason.empty()) grids = grids_of(setups);
    if (reason.empty() && grids.empty())
        reason = "fewer than two of the runs' setups are points of the paper's grids";
    if (!reason.empty()) {
        figure.missing.push_back(reason);
        return figure;
    }
    for (const SetupStatistics& setup : setups) {
        const statistics::Setup& s = setup.setup();
        const bool is_on_one = std::any_of(grids.begin(), grids.end(),
                                           [&](const Grid& grid) { return is_on(grid, s); });
        if (!is_on_one) figure.missing.push_back(setup.label + ": not a point of the drawn grids");
        if (const int n = collapsed_seeds(setup); is_on_one && n > 0)
            figure.missing.push_back(
                fmt::format("{}: in {} of {} a triangle is flipped, or below {} of its cell's mean",
                            setup.label, n, counted(setup.runs.size(), "seed"), k_collapsed));
    }
    // Grids side by side, or the measures of a single one.
    figure.plot.columns = static_cast<int>(grids.size() > 1 ? grids.size() : k_quantities.size());
    char letter = 'a';
    for (const Quantity& quantity : k_quantities) {
        for (const Grid& grid : grids) {
            const std::string panel(1, letter++);
            // the colour bar beside it names the measure
            reports::Plot::Panel map{panel + "  " + grid.name, "Et/ω", "γ/ω"};
            map.map = map_of(figure, setups, grid, quantity, panel);
            figure.plot.panels.push_back(std::move(map));
        }
        std::vector<reports::Plot::Map*> maps;
        for (std::size_t i = figure.plot.panels.size() - grids.size();
             i < figure.plot.panels.size(); ++i)
            maps.push_back(&*figure.plot.panels[i].map);
        set_common_range(maps);
    }
    for (const Grid& grid : k_grids)
        figure.missing.push_back(
            fmt::format("{}: {} of {} points have runs", grid.name, points_on(grid, setups),
                        grid.gamma_over_omega.size() * grid.Et_over_omega.size()));
    finish(figure, setups, "Fig. 7: over γ/ω and Et/ω");
    figure.plot.caption.push_back(fmt::format(
        "± standard error over seeds. † outside of the ranges of Table 2. "
        "‡ with the strain limiter. × with collapsed triangles. {}",
        grids.size() > 1 ? "One colour range for both maps of a measure."
                         : "Colours range over the values of this picture's maps alone."));
    return figure;
}

}  // namespace spheroscope::figures
