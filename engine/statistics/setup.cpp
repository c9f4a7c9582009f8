#include "engine/statistics/setup.hpp"

#include "engine/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <vector>

namespace spheroscope::statistics {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

/// The text without the line of the seed in [scene].
std::string without_seed(const std::string& scene) {
    std::istringstream lines(scene);
    std::string text, line;
    bool is_in_scene = false;
    while (std::getline(lines, line)) {
        if (line.rfind('[', 0) == 0) is_in_scene = line == "[scene]";
        if (is_in_scene && line.rfind("seed", 0) == 0) continue;
        text += line + "\n";
    }
    return text;
}

std::string_view name_of(scene::OmegaReading reading) {
    switch (reading) {
    case scene::OmegaReading::printed: return "printed";
    case scene::OmegaReading::text: return "text";
    case scene::OmegaReading::two_sided: return "two_sided";
    case scene::OmegaReading::per_cell: return "per_cell";
    case scene::OmegaReading::work_of_adhesion: return "work_of_adhesion";
    }
    return "";
}

}  // namespace

bool Setup::is_in_table_2() const {
    constexpr double slack = 1e-9;
    return E_kPa > 0.3125 - slack && E_kPa < 320.0 + slack && omega_nN_per_um > 0.0625 - slack &&
           omega_nN_per_um < 1.0 + slack;
}

bool Setup::is_in_table_2(double other_gamma_over_omega, double other_Et_over_omega) const {
    Setup other;
    other.omega_nN_per_um = gamma_nN_per_um / other_gamma_over_omega;
    other.E_kPa = other_Et_over_omega * other.omega_nN_per_um / thickness_um;
    return other.is_in_table_2();
}

Setup setup_of(const RunHeader& header, std::span<const Change> changes) {
    const scene::Scene scene = scene::parse_scene(header.resolved_scene, "the run's scene");
    Setup setup;
    std::vector<Change> felt;
    std::copy_if(changes.begin(), changes.end(), std::back_inserter(felt),
                 [](const Change& change) {
                     const ChangeableRow* const row = find_changeable(change.key);
                     return row == nullptr || row->of == ChangeableRow::Of::engine;
                 });
    setup.changes = changes_text(felt);
    setup.scene_alone = without_seed(header.resolved_scene);
    setup.scene_without_seed = setup.scene_alone + setup.changes;
    setup.title = scene.title;
    setup.n_cells = header.n_cells;
    setup.n_nodes = header.topology->n_nodes();
    const bool is_adhesive =
        scene.contact && scene.contact->adhesive && scene.contact->omega_nN_per_um > 0.0;
    setup.omega_nN_per_um = is_adhesive ? scene.contact->omega_nN_per_um : k_undefined;
    setup.W_nN_per_um = is_adhesive ? scene.contact->W_nN_per_um : k_undefined;
    setup.gamma_nN_per_um =
        scene.cortex.tension ? scene.cortex.tension->gamma_nN_per_um : k_undefined;
    setup.thickness_um = scene.cortex.thickness_um;
    setup.E_kPa = scene.cortex.elastic ? scene.cortex.elastic->E_kPa : k_undefined;
    if (scene.cortex.regularisation)
        setup.limiter_nN_per_um = scene.cortex.regularisation->kappa_nN_per_um;
    setup.gamma_over_omega = setup.gamma_nN_per_um / setup.omega_nN_per_um;
    setup.Et_over_omega = setup.E_kPa * scene.cortex.thickness_um / setup.omega_nN_per_um;
    if (scene.contact) {
        setup.law = scene.contact->law == scene::ContactLaw::traction ? "traction" : "variational";
        setup.omega_reading = name_of(scene.contact->omega_reading);
    }
    return setup;
}

std::string ratio_text(double ratio) {
    const double inverse = 1.0 / ratio;
    if (ratio > 0.0 && ratio < 1.0 && std::abs(inverse - std::round(inverse)) < 1e-6 * inverse)
        return fmt::format("1/{:.0f}", inverse);
    return fmt::format("{:.4g}", ratio);
}

}  // namespace spheroscope::statistics
