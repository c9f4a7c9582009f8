#include "engine/inspect/extract.hpp"

#include "engine/base/index.hpp"
#include "engine/inspect/inspect_contact.hpp"
#include "engine/scene/key_text.hpp"
#include "engine/stages/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string_view>

namespace spheroscope::inspect {
namespace {

/// Tables of the run's scene that do not belong to two cells alone: how they came about, what was
/// asked of the whole, and loads, which are among the held forces.
bool is_dropped(std::string_view header) {
    for (const std::string_view table : {"[scene]", "[cells", "[start]", "[load.", "[[stage]]",
                                         "[[picture]]", "[expect.", "[stability.", "[[variant]]"})
        if (header.starts_with(table)) return true;
    return false;
}

/// The tables that are kept, as they are in the run's own resolved scene, whose lines are either
/// the head of a table, a key, or empty.
std::string kept_tables(const std::string& resolved) {
    std::string kept;
    bool is_kept = false;
    std::istringstream lines(resolved);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('[')) {
            is_kept = !is_dropped(line);
            if (is_kept) kept += "\n" + line + "\n";
            continue;
        }
        // A second run is no part of the pair.
        const bool is_second_run =
            line.starts_with("mesh_error =") || line.starts_with("time_error =");
        if (is_kept && !is_second_run && !line.empty()) kept += line + "\n";
    }
    return kept;
}

std::string scene_text(const FrameSystem& frame, const ContactKey& key, const std::string& run_file,
                       double duration_s) {
    const scene::Scene& scene = frame.scene();
    const std::string file = scene::toml_string(run_file);
    std::string text = fmt::format(
        "# Cells {} and {} of a run of {}, frame {}, t = {} s.\n"
        "# The file below holds their positions, and what everything else did to them at that\n"
        "# moment: forces that [load.held] keeps as they are.\n",
        key.cell_a, key.cell_b, scene::toml_string(frame.header().scene_name), frame.frame().frame,
        frame.frame().time_s);
    text += fmt::format(
        "\n[scene]\ntitle = \"Contact {}\"\nseed = {}\nallow_full_wetting = {}\n\n[cells]\n"
        "arrangement = \"file\"\nnodes = {}\nfile = {}\nframe = 0\n\n[load.held]\n",
        key.text(), scene.seed, scene.allow_full_wetting, frame.system().model().n_nodes(), file);
    text += kept_tables(frame.header().resolved_scene);
    text += fmt::format("\n[[stage]]\nkind = \"relax\"\nduration = \"{} s\"\nevery = \"{} s\"\n",
                        duration_s, duration_s / 10.0);
    const auto& fields = scene.measures.fields;
    if (std::find(fields.begin(), fields.end(), "sigma_nn") != fields.end())
        text += "\n[[picture]]\nfield = \"sigma_nn\"\n";
    return text;
}

/// What was changed in the run until then, but for colours, as keys of its scene.
std::vector<scene::Override> overrides_of(const Snapshot& frame) {
    std::vector<scene::Override> overrides;
    if (frame.changes == nullptr) return overrides;
    for (const Change& change : *frame.changes) {
        const ChangeableRow& row = *find_changeable(change.key);
        if (row.of == ChangeableRow::Of::engine)
            overrides.push_back(
                {change.key, scene::format_quantity(change.values.at(0), row.dimension)});
    }
    return overrides;
}

void append(std::vector<float>& values, const Vec3& v) {
    for (const double component : {v.x(), v.y(), v.z()})
        values.push_back(static_cast<float>(component));
}

/// Forces of all terms that stay with the pair.
std::vector<Vec3> kept_forces_nN(System& pair) {
    std::vector<Vec3> sum(pair.model().n_all_nodes(), Vec3::Zero());
    for (const auto& term : pair.parts().terms) {
        if (pair.parts().is_load(*term)) continue;
        const std::vector<Vec3> F = pair.force_of_term(*term);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += F[i];
    }
    return sum;
}

/// Totals of two cells are not computed here: all undefined.
Totals no_totals() {
    Totals totals{};
    for (const TotalsRow& row : all_totals())
        if (const auto* member = std::get_if<double Totals::*>(&row.member))
            totals.** member = std::numeric_limits<double>::quiet_NaN();
    return totals;
}

/// What acts on the pair besides itself, from the velocities [all nodes of the run] that solve
/// Gamma v = F of the whole.
std::vector<Vec3> held_forces_nN(const Model& whole, std::span<const Vec3> v_um_per_s,
                                 FrameSystem& two) {
    System& pair = two.system();
    std::vector<Vec3> v_pair, held_nN(pair.model().n_all_nodes(), Vec3::Zero());
    for (const int cell : two.cells()) {
        const auto of_cell = whole.cell_nodes(v_um_per_s, cell);
        v_pair.insert(v_pair.end(), of_cell.begin(), of_cell.end());
    }
    pair.friction_product(v_pair, held_nN);
    const std::vector<Vec3> kept_nN = kept_forces_nN(pair);
    for (std::size_t i = 0; i < held_nN.size(); ++i) held_nN[i] -= kept_nN[i];
    return held_nN;
}

/// The pair as the only frame of a run of its own.
Snapshot alone(const FrameSystem& frame, const FrameSystem& two, const ContactKey& key,
               std::shared_ptr<const RunHeader> header) {
    const Configuration at = two.system().configuration();
    Snapshot snapshot;
    snapshot.header = std::move(header);
    snapshot.stage_name = "relax";
    snapshot.stage_progress = 0.0;
    for (const Vec3& x : at.x_um) append(snapshot.x_um, x);
    for (const Vec3& gradient : at.geometry.volume_gradient_um2)
        append(snapshot.normal, gradient.normalized());
    for (std::size_t c = 0; c < 2; ++c) {
        append(snapshot.centre_um, at.geometry.centre_um[c]);
        const auto cell = idx(two.cells()[c]);
        snapshot.pressure_kPa.push_back(frame.frame().pressure_kPa[cell]);
        snapshot.volume_um3.push_back(static_cast<float>(at.geometry.volume_um3[c]));
    }
    const ContactSummary summary = summarize(two, key);
    snapshot.links.push_back(
        {0, 1, static_cast<float>(summary.centre_force_nN), static_cast<float>(summary.area_um2)});
    snapshot.totals = no_totals();
    return snapshot;
}

}  // namespace

ExtractedPair extract_pair(FrameSystem& frame, const ContactKey& key, const std::string& run_file,
                           double duration_s) {
    check_cells(frame.header(), key);
    const std::string number = std::to_string(frame.frame().frame);
    if (frame.scene().stages[idx(frame.frame().stage)].kind == scene::StageKind::anneal)
        throw Error("frame " + number + " shows beads that are being packed",
                    "there are contacts with forces in later stages");
    if (!summarize(frame, key).exists)
        static_cast<void>(inspect_contact(frame, key));  // throws, with the nearest contacts
    const std::vector<Vec3> v = solved_velocities_um_per_s(frame);
    FrameSystem two(std::make_shared<RunHeader>(frame.header()), {key.cell_a, key.cell_b},
                    FrameSystem::Detail::forces);
    two.load(std::make_shared<Snapshot>(frame.frame()));

    ExtractedPair result;
    result.load.force_nN = held_forces_nN(frame.system().model(), v, two);
    const auto integral_s = two.system().configuration().volume_integral_s;
    result.load.volume_integral_s.assign(integral_s.begin(), integral_s.end());
    result.scene_toml = scene_text(frame, key, run_file, duration_s);
    const std::vector<scene::Override> overrides = overrides_of(frame.frame());
    const scene::Scene scene =
        scene::parse_scene(result.scene_toml, "the extracted scene", overrides);
    if (!overrides.empty())  // under the comment that says where it comes from
        result.scene_toml =
            result.scene_toml.substr(0, result.scene_toml.find("\n[")) + "\n" + scene.resolved_toml;
    auto header = std::make_shared<RunHeader>();
    header->topology = two.system().model().topology;
    header->n_cells = 2;
    header->title = scene.title;
    header->scene_name = frame.header().scene_name;
    header->resolved_scene = scene.resolved_toml;
    header->seed = scene.seed;
    header->version = frame.header().version;
    header->command_line = frame.header().command_line;
    header->contact_arithmetic = frame.header().contact_arithmetic;
    for (const int cell : two.cells())
        header->radius_um.push_back(frame.header().radius_um[idx(cell)]);
    result.header = header;
    result.frame = alone(frame, two, key, std::move(header));
    return result;
}

}  // namespace spheroscope::inspect
