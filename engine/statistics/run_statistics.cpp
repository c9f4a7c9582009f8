#include "engine/statistics/run_statistics.hpp"

#include "engine/run/aggregate_shape.hpp"
#include "engine/statistics/seed_mean.hpp"
#include "engine/statistics/void_fraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace spheroscope::statistics {
namespace {

std::vector<double> values_of(const std::vector<CellStress>& cells, const CellStressRow& row) {
    std::vector<double> values;
    for (const CellStress& cell : cells) values.push_back(cell.*row.member);
    return values;
}

using LabelPart = std::string (*)(const Setup&);
constexpr std::size_t k_Et_over_omega = 1;  // in the table
const std::array<LabelPart, 9> k_label_parts{
    [](const Setup& s) { return "γ/ω = " + ratio_text(s.gamma_over_omega); },
    [](const Setup& s) { return "Et/ω = " + ratio_text(s.Et_over_omega); },
    [](const Setup& s) { return fmt::format("N = {}", s.n_cells); },
    [](const Setup& s) { return fmt::format("{} nodes", s.n_nodes); },
    [](const Setup& s) { return s.law; },
    [](const Setup& s) { return "reading " + s.omega_reading; },
    [](const Setup& s) { return fmt::format("ω = {:.4g} nN/µm", s.omega_nN_per_um); },
    [](const Setup& s) {
        return std::string(s.changes.empty() ? "unchanged" : "changed on its way");
    },
    [](const Setup& s) { return s.title; },
};

/// The two ratios are what the paper names its cases by; what comes after them in the table is
/// written where it is needed to tell setups apart.
void label(std::vector<SetupStatistics>& setups) {
    for (std::size_t p = 0; p < k_label_parts.size(); ++p) {
        std::set<std::string> with_part, labels;
        for (const SetupStatistics& s : setups) {
            with_part.insert(s.label + k_label_parts[p](s.setup()));
            labels.insert(s.label);
        }
        if (p > k_Et_over_omega && with_part.size() == labels.size()) continue;
        for (SetupStatistics& s : setups) {
            const std::string part = (p == 0 ? "" : ", ") + k_label_parts[p](s.setup());
            s.label += part;
            if (p != k_Et_over_omega) s.family += part;
        }
    }
    std::map<std::string, int> n_with, n_of;
    for (const SetupStatistics& s : setups) ++n_with[s.label];
    for (SetupStatistics& s : setups) {
        if (n_with[s.label] > 1) s.shared_label = s.label;
        const int number = ++n_of[s.label];
        if (number == 1) continue;
        s.label += fmt::format(" ({})", number);
        s.family += fmt::format(" ({})", number);
    }
}

}  // namespace

bool RunStatistics::has_ended() const {
    return outcome == "done" || outcome == "rest" || outcome == "stationary" || outcome == "cap";
}

double RunStatistics::coordination_at(double threshold_um2) const {
    return coordination(pairs, setup.n_cells, threshold_um2);
}

double RunStatistics::mean_stress_kPa(const CellStressRow& row, Weighting weighting) const {
    return mean_over_seeds(values_of(weighting == Weighting::equal ? equal_kPa : area_kPa, row))
        .mean;
}

double RunStatistics::mean_stress_of_layer_kPa(const CellStressRow& row, bool of_core) const {
    std::vector<double> values;
    for (std::size_t cell = 0; cell < is_core.size(); ++cell)
        if ((is_core[cell] != 0) == of_core) values.push_back(equal_kPa[cell].*row.member);
    return mean_over_seeds(values).mean;
}

RunStatistics measure_run(const SnapshotPtr& frame, std::span<const Change> changes) {
    const RunHeader& header = *frame->header;
    inspect::FrameSystem system(frame->header, {}, inspect::FrameSystem::Detail::contacts);
    const auto stage = static_cast<std::size_t>(frame->stage);
    if (stage < system.scene().stages.size() &&
        system.scene().stages[stage].kind == scene::StageKind::anneal)
        throw Error("beads are being packed in its last frame: there is no mechanics yet");
    system.load(frame);
    const Aggregate aggregate = aggregate_of(system);

    RunStatistics run;
    run.seed = header.seed;
    run.version = header.version;
    run.stage_name = frame->stage_name;
    run.time_s = frame->time_s;
    run.last_dt_s = frame->diagnostics.dt_s;
    run.setup = setup_of(header, changes);
    run.totals = frame->totals;
    run.R_th_um = aggregate.R_th_um;
    run.extent_um = aggregate_extent_um(*frame);
    const Probes probes = random_probes(aggregate, header.seed);
    run.sigma_h_nearest_kPa =
        sample_cells(aggregate, probes, aggregate.sigma_h_kPa, Interpolation::nearest_cell);
    run.sigma_h_smooth_kPa =
        sample_cells(aggregate, probes, aggregate.sigma_h_kPa, Interpolation::inverse_distance);
    run.voids = void_samples(aggregate, probes);
    run.tension_nN_per_um = tension_by_region(aggregate);
    run.sigma_nn = stress_at_pores(aggregate);
    run.equal_kPa = stress_of_cells(aggregate, Weighting::equal);
    run.area_kPa = stress_of_cells(aggregate, Weighting::area);
    for (int cell = 0; cell < aggregate.n_cells(); ++cell)
        run.is_core.push_back(aggregate.is_core(cell) ? 1 : 0);
    for (std::size_t r = 0; r < all_cell_stresses().size(); ++r)
        run.cell_stress_kPa[r] =
            sample_cells(aggregate, probes, values_of(run.equal_kPa, all_cell_stresses()[r]),
                         Interpolation::nearest_cell);
    run.pairs = aggregate.pairs;
    run.touching_area_um2 = aggregate.touching_area_um2;
    return run;
}

std::vector<SetupStatistics> group_by_setup(std::vector<RunStatistics> runs) {
    const auto key = [](const RunStatistics& r) {
        const auto defined = [](double ratio) { return std::isnan(ratio) ? -1.0 : ratio; };
        return std::make_tuple(defined(r.setup.gamma_over_omega), defined(r.setup.Et_over_omega),
                               r.setup.n_cells, r.setup.scene_without_seed, r.seed);
    };
    const auto order = [&](const RunStatistics& a, const RunStatistics& b) {
        return key(a) < key(b);
    };
    std::stable_sort(runs.begin(), runs.end(), order);
    std::vector<SetupStatistics> setups;
    for (RunStatistics& run : runs) {
        const bool is_new = setups.empty() || setups.back().setup().scene_without_seed !=
                                                  run.setup.scene_without_seed;
        if (is_new) setups.emplace_back();
        std::vector<RunStatistics>& replicates = setups.back().runs;
        if (!is_new && replicates.back().seed == run.seed)
            throw Error(fmt::format("{} and {} are runs of the same scene with the same seed {}",
                                    replicates.back().file, run.file, run.seed),
                        "replicates have different seeds");
        replicates.push_back(std::move(run));
    }
    label(setups);
    return setups;
}

}  // namespace spheroscope::statistics
