#include "engine/cli/bead_setup.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/make_folder.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/stages/bead_packing.hpp"
#include "engine/stages/jamming.hpp"
#include "engine/statistics/seed_mean.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

namespace spheroscope::cli {
namespace {

/// Far enough above jamming that random beads settle at once, near enough that few are squeezed
/// out.
constexpr double k_first_fraction = 0.665;
/// How near to the jamming point the last packing is.
constexpr double k_nearest = 1e-5;

struct Jammed {
    double jamming_fraction = 0.0, coordination = 0.0, rattlers = 0.0, exponent = 0.0;
    double wall_s = 0.0;
    std::string version;
};

struct NumberRow {
    const char* name;
    double Jammed::*member;
};
constexpr std::array<NumberRow, 4> k_numbers{{{"jamming_fraction", &Jammed::jamming_fraction},
                                              {"coordination_at_jamming", &Jammed::coordination},
                                              {"rattlers_at_jamming", &Jammed::rattlers},
                                              {"coordination_exponent", &Jammed::exponent}}};

Jammed jam(int n_beads, std::uint64_t seed, const std::string& version) {
    const auto begin = std::chrono::steady_clock::now();
    const JammingRun run =
        decompress_to_jamming(draw_radii({}, n_beads, seed), k_first_fraction, k_nearest, seed);
    Jammed jammed;
    jammed.jamming_fraction = run.jamming_fraction;
    jammed.coordination = run.settled.back().coordination;
    jammed.rattlers = run.settled.back().rattlers;
    jammed.exponent = coordination_exponent(run);
    jammed.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    jammed.version = version;
    return jammed;
}

void write(const std::string& path, const Jammed& jammed, int n_beads, std::uint64_t seed) {
    nlohmann::json document{
        {"beads", n_beads}, {"seed", seed}, {"version", jammed.version}, {"wall_s", jammed.wall_s}};
    for (const NumberRow& row : k_numbers) document[row.name] = jammed.*row.member;
    write_text_file(path, document.dump(2) + "\n");
}

/// Throws Error when the file is damaged or of other beads.
Jammed read(const std::string& path, int n_beads, std::uint64_t seed) {
    std::ifstream file(path);
    Jammed jammed;
    try {
        const nlohmann::json document = nlohmann::json::parse(file);
        if (document.at("beads") != n_beads || document.at("seed") != seed)
            throw Error(Loc{path},
                        fmt::format("wanted {} of seed {}, got {} of seed {}",
                                    counted(n_beads, "bead"), seed, document.at("beads").dump(),
                                    document.at("seed").dump()),
                        "delete it, or choose another folder with -o");
        for (const NumberRow& row : k_numbers) jammed.*row.member = document.at(row.name);
        jammed.wall_s = document.at("wall_s");
        jammed.version = document.at("version");
    } catch (const nlohmann::json::exception& error) {
        throw Error(Loc{path}, fmt::format("cannot be read: {}", error.what()),
                    "delete it, and it is made again");
    }
    return jammed;
}

}  // namespace

claims::MeasuredSetup measure_beads(const claims::ClaimedSetup& setup, const std::string& folder,
                                    const std::vector<std::uint64_t>& seeds, bool makes_runs,
                                    const std::string& version) {
    claims::MeasuredSetup measured;
    measured.n_cells = setup.beads;
    measured.law = "-";
    std::vector<Jammed> all;
    for (const std::uint64_t seed : seeds) {
        if (interrupt_signal() != 0) break;
        const std::string path =
            fmt::format("{}/{}/seed={}/jamming.json", folder, setup.name, seed);
        try {
            if (!std::filesystem::exists(path)) {
                if (!makes_runs) continue;
                log_info(fmt::format("{}, seed {}", setup.name, seed));
                // before the minutes that the beads take
                make_folder(std::filesystem::path(path).parent_path().string());
                write(path, jam(setup.beads, seed, version), setup.beads, seed);
            }
            all.push_back(read(path, setup.beads, seed));
            measured.runs.push_back({seed, "jammed", all.back().version, 0.0, all.back().wall_s});
        } catch (const Error& error) {
            log_error(fmt::format("{}, seed {}: {}", setup.name, seed, error.what()));
            measured.troubles.push_back(fmt::format("seed {}: {}", seed, error.what()));
        }
    }
    if (all.empty()) return measured;
    for (const NumberRow& row : k_numbers) {
        statistics::SetupNumber number{row.name, "1", {}, {}};
        for (const Jammed& jammed : all) number.by_run.push_back(jammed.*row.member);
        number.estimate = statistics::mean_over_seeds(number.by_run);
        measured.numbers.push_back(std::move(number));
    }
    return measured;
}

}  // namespace spheroscope::cli
