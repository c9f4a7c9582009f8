#include "engine/statistics/setup_numbers.hpp"

#include "engine/statistics/derived_numbers.hpp"
#include "engine/statistics/radial_profile.hpp"
#include "engine/statistics/tail_exponent.hpp"
#include "engine/statistics/void_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope::statistics {
namespace {

constexpr double k_Pa_per_kPa = 1000.0;

/// Numbers of one setup, one after the other.
class Numbers {
  public:
    explicit Numbers(const SetupStatistics& setup) : setup_(setup) {}

    template <class F> void add(std::string name, std::string unit, const F& value) {
        SetupNumber number{std::move(name), std::move(unit), {}};
        for (const RunStatistics& run : setup_.runs) number.by_run.push_back(value(run));
        number.estimate = mean_over_seeds(number.by_run);
        numbers_.push_back(std::move(number));
    }
    void add_of_all(std::string name, std::string unit, const Estimate& estimate) {
        numbers_.push_back({std::move(name), std::move(unit), estimate});
    }
    [[nodiscard]] std::vector<SetupNumber> take() { return std::move(numbers_); }

  private:
    const SetupStatistics& setup_;
    std::vector<SetupNumber> numbers_;
};

using PlaceInProfile = double (*)(std::span<const ProfilePoint>);

/// Depths are counted from a surface: the sphere with the volume of all cells, or the sphere that
/// just holds all nodes. Cells of loose aggregates reach farther out than the first.
using Surface = double (*)(const RunStatistics&);
double equivalent_sphere_um(const RunStatistics& run) { return run.R_th_um; }
double farthest_node_um(const RunStatistics& run) { return run.extent_um; }

/// Depth below R_th at which sigma_h of one run changes its sign, or is largest.
double depth_um(const RunStatistics& run, PlaceInProfile place) {
    const std::vector<std::vector<ProbeSample>> one{run.sigma_h_nearest_kPa};
    return (1.0 - place(pooled_profile(one))) * run.R_th_um;
}

/// The same of the probes of all runs together, as the paper has it: one run is too few cells for a
/// profile. The error is the jackknife's, each run left out once, and not below half the grid that
/// the place is found on, `resolution_over_R_th`.
Estimate pooled_depth_um(const SetupStatistics& setup, PlaceInProfile place, Surface surface,
                         double resolution_over_R_th) {
    const std::size_t n = setup.runs.size();
    double R_th_um = 0.0;  // mean
    for (const RunStatistics& run : setup.runs) R_th_um += run.R_th_um / static_cast<double>(n);
    const auto without = [&](std::size_t left_out) {
        std::vector<std::vector<ProbeSample>> samples;
        double R_um = 0.0, surface_um = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            if (i != left_out) {
                samples.push_back(setup.runs[i].sigma_h_nearest_kPa);
                R_um += setup.runs[i].R_th_um;
                surface_um += surface(setup.runs[i]);
            }
        return (surface_um - place(pooled_profile(samples)) * R_um) /
               static_cast<double>(samples.size());
    };
    Estimate depth;
    depth.mean = without(n);  // none
    depth.n = static_cast<int>(n);
    if (n < 2) return depth;
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(without(i));
    // The standard error of their mean, of values that differ by (n - 1) times less than seeds do.
    depth.standard_error =
        std::max(static_cast<double>(n - 1) * mean_over_seeds(values).standard_error,
                 0.5 * resolution_over_R_th * R_th_um);
    return depth;
}

void add_totals(Numbers& numbers) {
    for (const TotalsRow& row : all_totals())
        numbers.add(std::string(row.name), std::string(row.unit),
                    [&](const RunStatistics& run) { return value_of(row, run.totals); });
}

void add_profile(Numbers& numbers, const SetupStatistics& setup) {
    numbers.add("sigma_h_zero_depth", "um",
                [](const RunStatistics& run) { return depth_um(run, zero_crossing); });
    numbers.add("sigma_h_peak_depth", "um",
                [](const RunStatistics& run) { return depth_um(run, peak); });
    numbers.add("extent", "um", farthest_node_um);
    const auto add_pooled = [&](const std::string& name, PlaceInProfile place, double resolution) {
        numbers.add_of_all(name + "_pooled", "um",
                           pooled_depth_um(setup, place, equivalent_sphere_um, resolution));
        numbers.add_of_all(name + "_below_farthest_node", "um",
                           pooled_depth_um(setup, place, farthest_node_um, resolution));
    };
    add_pooled("sigma_h_zero_depth", zero_crossing, 0.0);  // interpolated between bins
    add_pooled("sigma_h_peak_depth", peak, k_bin_width);
    // The paper defines sigma_h as the whole trace once, and as a third of it once.
    numbers.add("core_trace_over_2_omega_R", "1",
                [](const RunStatistics& run) { return 3.0 * (1.0 - run.totals.eps_YL_omega); });
    numbers.add("void_fraction", "1",
                [](const RunStatistics& run) { return void_fraction(run.voids, 0.5); });
    numbers.add("rim_share", "1", [](const RunStatistics& run) {
        return 1.0 - static_cast<double>(run.totals.n_core_cells) / run.setup.n_cells;
    });
}

void add_bulk_modulus(Numbers& numbers) {
    numbers.add("bulk_modulus_moving", "kPa",
                [](const RunStatistics& run) { return bulk_modulus_moving_kPa(run.wall); });
    numbers.add("bulk_modulus_held", "kPa", [](const RunStatistics& run) {
        // Under a bead the aggregate is not free.
        return run.load.empty() ? bulk_modulus_held_kPa(run.wall, run.extent_um)
                                : std::numeric_limits<double>::quiet_NaN();
    });
}

void add_regions(Numbers& numbers) {
    for (std::size_t r = 0; r < k_regions.size(); ++r)
        numbers.add("gamma_eff, " + std::string(name_of(k_regions[r])), "mN/m",
                    [&](const RunStatistics& run) { return run.tension_nN_per_um[r]; });
    numbers.add("sigma_nn, at pores", "Pa",
                [](const RunStatistics& run) { return k_Pa_per_kPa * run.sigma_nn.at_pores_kPa; });
    numbers.add("sigma_nn, core away from pores", "Pa",
                [](const RunStatistics& run) { return k_Pa_per_kPa * run.sigma_nn.elsewhere_kPa; });
}

void add_stresses(Numbers& numbers) {
    for (const CellStressRow& row : all_cell_stresses())
        for (const auto weighting : {Weighting::equal, Weighting::area})
            numbers.add(std::string(row.quantity) +
                            (weighting == Weighting::area ? "_by_area" : ""),
                        "Pa", [&](const RunStatistics& run) {
                            return k_Pa_per_kPa * run.mean_stress_kPa(row, weighting);
                        });
    for (const CellStressRow& row : all_cell_stresses())
        for (const bool is_core : {false, true})
            numbers.add(std::string(row.quantity) + (is_core ? ", core cells" : ", rim cells"),
                        "Pa", [&](const RunStatistics& run) {
                            return k_Pa_per_kPa * run.mean_stress_of_layer_kPa(row, is_core);
                        });
}

void add_forces(Numbers& numbers, const SetupStatistics& setup) {
    const auto forces = [](const RunStatistics& run) {
        return contact_forces(run.pairs, run.touching_area_um2, ForceNorm::all);
    };
    numbers.add("mean_contact_force", "nN",
                [&](const RunStatistics& run) { return forces(run).mean_nN; });
    numbers.add("tensile_share", "1",
                [&](const RunStatistics& run) { return forces(run).tensile_share; });
    for (const auto scale : {TailScale::one, TailScale::free}) {
        const TailFit fit = fit_tail(pooled_forces(setup, ForceNorm::all), scale);
        Estimate exponent;
        if (fit.exists())
            exponent = {fit.beta, fit.beta_error, static_cast<int>(setup.runs.size())};
        numbers.add_of_all(scale == TailScale::one ? "beta_b_1" : "beta_b_free", "1", exponent);
    }
}

}  // namespace

std::vector<double> pooled_forces(const SetupStatistics& setup, ForceNorm norm) {
    std::vector<double> pooled;
    for (const RunStatistics& run : setup.runs) {
        const ContactForces forces = contact_forces(run.pairs, run.touching_area_um2, norm);
        pooled.insert(pooled.end(), forces.f.begin(), forces.f.end());
    }
    return pooled;
}

std::vector<SetupNumber> numbers_of(const SetupStatistics& setup) {
    Numbers numbers(setup);
    add_totals(numbers);
    add_profile(numbers, setup);
    add_bulk_modulus(numbers);
    add_regions(numbers);
    add_stresses(numbers);
    add_forces(numbers, setup);
    std::vector<SetupNumber> all = numbers.take();
    add_derived_numbers(all, setup.setup().law);
    return all;
}

}  // namespace spheroscope::statistics
