#include "engine/scene/limits.hpp"

#include "engine/base/error.hpp"
#include "engine/scene/value_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

double gamma_of(const Scene& scene) {
    return scene.cortex.tension ? scene.cortex.tension->gamma_nN_per_um : 0.0;
}

}  // namespace

std::string problem_of_number(std::string_view path, double value) {
    const Key* const key = find_key(path);
    SPHEROSCOPE_ASSERT(key != nullptr, "a key of scenes");
    const std::string wanted =
        std::isfinite(value) ? missed_limits(*key, value) : "a finite number";
    if (wanted.empty()) return "";
    return fmt::format("{} must be {}, got {}", path, wanted,
                       format_quantity(value, key->dimension));
}

std::string problem_of_range(const std::array<double, 2>& range) {
    for (const double end : range)
        if (std::string problem = problem_of_number("picture.given_range", end); !problem.empty())
            return problem;
    if (range[0] < range[1]) return "";
    return fmt::format("picture.given_range wants [lowest, highest], got [{}, {}]", range[0],
                       range[1]);
}

bool wets_fully(const Scene& scene) {
    // relative: both are products of a few rounded numbers
    const double limit_nN_per_um = 2.0 * gamma_of(scene);
    return std::abs(scene.contact->W_nN_per_um - limit_nN_per_um) <= 1e-12 * limit_nN_per_um;
}

std::string problem_of_wetting(const Scene& scene) {
    if (!scene.contact || !scene.contact->adhesive || scene.allow_full_wetting) return "";
    const double limit_nN_per_um = 2.0 * gamma_of(scene);
    if (wets_fully(scene) || scene.contact->W_nN_per_um < limit_nN_per_um) return "";
    const std::string beyond = scene.cortex.tension
                                   ? fmt::format("is above 2 gamma = {} nN/um", limit_nN_per_um)
                                   : std::string("has no [cortex.tension] to resist it");
    return fmt::format("W = {} nN/um (omega_reading = \"{}\") {}: cells flatten without limit",
                       scene.contact->W_nN_per_um, word_of(scene.contact->omega_reading), beyond);
}

}  // namespace spheroscope::scene
