#include "engine/scene/resolve.hpp"

#include "engine/scene/limits.hpp"
#include "engine/scene/shots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

namespace spheroscope::scene {
namespace {

double gamma_of(const Scene& scene) {
    return scene.cortex.tension ? scene.cortex.tension->gamma_nN_per_um : 0.0;
}

void warn(Scene& scene, const Loc& loc, const std::string& message) {
    scene.warnings.push_back(fmt::format("{}: {}", loc.text(), message));
}

Loc loc_of(const Draft& draft, std::string_view path) { return draft.document->loc_of(path); }

// ---- cells -------------------------------------------------------------------------------------

double smallest_radius(const Cells& cells) {
    if (cells.radius.fixed_um) return *cells.radius.fixed_um;
    if (cells.arrangement != Arrangement::centres) return cells.radius.min_um;
    double smallest = cells.centres_um.front()[3];
    for (const auto& row : cells.centres_um) smallest = std::min(smallest, row[3]);
    return smallest;
}

void check_radius(const Draft& draft) {
    const Cells& cells = draft.scene.cells;
    const Radius& radius = cells.radius;
    const Loc loc = draft.given("cells.radius") ? loc_of(draft, "cells.radius") : cells.loc;
    if (!radius.fixed_um && !(radius.min_um < radius.max_um))
        throw Error(loc, fmt::format("cells.radius.min ({} um) must be below cells.radius.max "
                                     "({} um)",
                                     radius.min_um, radius.max_um));
    const double mean_um = radius.shape * radius.scale_um;
    if (!radius.fixed_um && !(mean_um > radius.min_um && mean_um < radius.max_um))
        throw Error(loc, fmt::format("the mean radius shape * scale = {:.4g} um must lie between "
                                     "min = {} um and max = {} um",
                                     mean_um, radius.min_um, radius.max_um));
}

void resolve_cells(Draft& draft) {
    Scene& scene = draft.scene;
    Cells& cells = scene.cells;
    switch (cells.arrangement) {
    case Arrangement::single: cells.count = 1; break;
    case Arrangement::pair: cells.count = 2; break;
    case Arrangement::centres: cells.count = static_cast<int>(cells.centres_um.size()); break;
    default: break;
    }
    if (cells.arrangement == Arrangement::file) {
        if (cells.file.empty())
            throw Error(loc_of(draft, "cells.file"),
                        "cells.file wants the name of a file, got \"\"");
        return;
    }
    if (cells.count < 1)
        throw Error(loc_of(draft, "cells.centres"),
                    "cells.centres wants one row [x, y, z, radius] or more, got none");
    for (std::size_t k = 0; k < cells.centres_um.size(); ++k)
        if (!(cells.centres_um[k][3] > 0.0))
            throw Error(loc_of(draft, "cells.centres"),
                        fmt::format("cells.centres: the radius of row {} must be > 0, got {} um", k,
                                    cells.centres_um[k][3]));
    if (cells.arrangement != Arrangement::centres) check_radius(draft);
    const double limit_um = smallest_radius(cells);
    if (scene.cortex.thickness_um >= limit_um)
        throw Error(
            loc_of(draft, "cortex.thickness"),
            fmt::format("cortex.thickness ({} um) must be below the smallest radius ({} um)",
                        scene.cortex.thickness_um, limit_um));
    if (scene.contact && scene.contact->h0_um >= limit_um)
        throw Error(loc_of(draft, "contact.h0"),
                    fmt::format("contact.h0 ({} um) must be below the smallest radius ({} um)",
                                scene.contact->h0_um, limit_um));
}

// ---- contact -----------------------------------------------------------------------------------

/// Work of adhesion over omega, and equilibrium overlap over h0, of the readings of omega that have
/// one: the paper's pressure, stiffness, energy and text do not agree on a factor of 2.
struct Reading {
    double W_over_omega, overlap_h0;
};

Reading reading_of(OmegaReading reading) {
    switch (reading) {
    case OmegaReading::printed: return {0.5, 1.0};
    case OmegaReading::text: return {1.0, 2.0};
    case OmegaReading::two_sided: return {1.0, 1.0};
    case OmegaReading::per_cell: return {2.0, 2.0};
    case OmegaReading::work_of_adhesion: break;
    }
    SPHEROSCOPE_ASSERT(false, "a work of adhesion needs no reading");
    return {};
}

void resolve_adhesion(Draft& draft) {
    Scene& scene = draft.scene;
    Contact& contact = *scene.contact;
    const bool by_W = draft.given("contact.adhesion.W");
    const bool says_W = contact.omega_reading == OmegaReading::work_of_adhesion;
    if (by_W && draft.given("contact.omega_reading") && !says_W)
        throw Error(loc_of(draft, "contact.omega_reading"),
                    "contact.omega_reading says how to read omega, but contact.adhesion.W is given",
                    "leave it out, or give contact.adhesion.omega");
    if (says_W && !by_W)
        throw Error(loc_of(draft, "contact.omega_reading"),
                    "contact.omega_reading = \"work_of_adhesion\" wants contact.adhesion.W");
    if (by_W) {
        contact.omega_reading = OmegaReading::work_of_adhesion;
        contact.equilibrium_overlap_h0 = draft.equilibrium_overlap;
        return;
    }
    if (draft.gamma_over_omega) {
        if (!scene.cortex.tension)
            throw Error(loc_of(draft, "contact.adhesion.gamma_over_omega"),
                        "contact.adhesion.gamma_over_omega needs [cortex.tension]");
        contact.omega_nN_per_um = gamma_of(scene) / *draft.gamma_over_omega;
    }
    const Reading reading = reading_of(contact.omega_reading);
    contact.W_nN_per_um = reading.W_over_omega * contact.omega_nN_per_um;
    contact.equilibrium_overlap_h0 = reading.overlap_h0;
}

void check_wetting(Draft& draft) {
    const Loc loc = loc_of(draft, "contact.adhesion");
    if (wets_fully(draft.scene))
        warn(draft.scene, loc,
             fmt::format("W = {} nN/um (omega_reading = \"{}\") equals 2 gamma: full wetting, "
                         "contacts have no tension left",
                         draft.scene.contact->W_nN_per_um,
                         word_of(draft.scene.contact->omega_reading)));
    if (const std::string problem = problem_of_wetting(draft.scene); !problem.empty())
        throw Error(loc, problem, std::string(k_allow_wetting));
}

/// The rim of a contact advances from node to node. The surface beyond it stands off at some angle,
/// and adhesion that does not reach the next node leaves the rim where it is: doublets of the
/// paper's values had 20 % less contact than on fine meshes at h0 = 0.037 edges, 70 % less at 0.011
/// (engine/README.md, 'Stability').
void check_mesh_for_adhesion(Draft& draft) {
    constexpr double least_h0_over_edge = 0.05;
    const Scene& scene = draft.scene;
    const Contact& contact = *scene.contact;
    if (contact.allow_coarse_mesh || scene.cells.arrangement == Arrangement::file) return;
    double radius_um = scene.cells.radius.fixed_um.value_or(scene.cells.radius.shape *
                                                            scene.cells.radius.scale_um);
    if (!scene.cells.centres_um.empty()) {
        radius_um = 0.0;
        for (const auto& row : scene.cells.centres_um) radius_um = std::max(radius_um, row[3]);
    }
    // 2 n - 4 equilateral triangles tile the sphere
    const double triangle_um2 =
        4.0 * std::numbers::pi * radius_um * radius_um / (2.0 * scene.cells.nodes - 4.0);
    const double edge_um = std::sqrt(4.0 / std::numbers::sqrt3 * triangle_um2);
    if (contact.h0_um >= least_h0_over_edge * edge_um) return;
    throw Error(
        loc_of(draft, "contact.h0"),
        fmt::format("contact.h0 = {:g} um is too small for the mesh: edges are {:.2g} um "
                    "long with cells.nodes = {}, and the rim of a contact catches on them "
                    "below {:.2g} um",
                    contact.h0_um, edge_um, scene.cells.nodes, least_h0_over_edge * edge_um),
        "a finer mesh, or contact.allow_coarse_mesh = true for contacts that stay too small");
}

void resolve_contact(Draft& draft) {
    Scene& scene = draft.scene;
    if (!scene.contact) return;
    scene.contact->adhesive = draft.given("contact.adhesion");
    if (scene.cells.count == 1)
        throw Error(scene.contact->loc, "a single cell has nothing to touch: remove [contact]");
    if (!scene.contact->adhesive) return;
    resolve_adhesion(draft);
    check_wetting(draft);
    check_mesh_for_adhesion(draft);
}

// ---- cortex and cytosol
// --------------------------------------------------------------------------

void resolve_elastic(Draft& draft) {
    Scene& scene = draft.scene;
    Cortex& cortex = scene.cortex;
    if (draft.Et_over_omega) {
        if (!scene.contact || scene.contact->omega_nN_per_um <= 0.0)
            throw Error(loc_of(draft, "cortex.elastic.Et_over_omega"),
                        "cortex.elastic.Et_over_omega needs contact.adhesion.omega");
        cortex.elastic->E_kPa =
            *draft.Et_over_omega * scene.contact->omega_nN_per_um / cortex.thickness_um;
    }
    if (cortex.bending && !draft.given("cortex.bending.E")) {
        if (!cortex.elastic)
            throw Error(cortex.bending->loc, "cortex.bending.E is missing; it is required without "
                                             "[cortex.elastic]");
        cortex.bending->E_kPa = cortex.elastic->E_kPa;
    }
}

void resolve_regularisation(Draft& draft) {
    Cortex& cortex = draft.scene.cortex;
    if (!cortex.regularisation) return;
    Regularisation& guard = *cortex.regularisation;
    if (!cortex.elastic || !cortex.tension)
        throw Error(guard.loc,
                    "[cortex.regularisation] needs [cortex.elastic] and [cortex.tension]");
    const double Et = cortex.elastic->E_kPa * cortex.thickness_um;
    if (!draft.given("cortex.regularisation.kappa"))
        guard.kappa_nN_per_um = std::max(0.0, 0.5 * cortex.tension->gamma_nN_per_um - Et);
    if (guard.kappa_nN_per_um == 0.0)
        warn(draft.scene, guard.loc,
             fmt::format("[cortex.regularisation] has kappa = 0 and does nothing (E t = {} nN/um, "
                         "gamma = {} nN/um)",
                         Et, cortex.tension->gamma_nN_per_um));
}

/// c / 2 gamma with c = eta t / sqrt(3): the paper's zeta, by which its printed times come out to
/// all digits. Nothing without tension or viscosity.
std::optional<double> relaxation_time(const Scene& scene) {
    const Cortex& cortex = scene.cortex;
    if (!cortex.tension || !cortex.viscosity) return std::nullopt;
    return cortex.viscosity->eta_kPa_s * cortex.thickness_um /
           (2.0 * std::numbers::sqrt3 * cortex.tension->gamma_nN_per_um);
}

void resolve_times(Draft& draft) {
    Scene& scene = draft.scene;
    const std::optional<double> zeta_s = relaxation_time(scene);
    Method& method = scene.method;
    // Its time is no time: nothing but the output interval bounds its steps.
    if (method.name == "equilibrium" && !draft.given("method.dt_max")) method.dt_max_s = 1e6;
    // the paper's step is zeta / 30
    if (!draft.given("method.dt"))
        method.dt_s = std::min(zeta_s ? *zeta_s / 30.0 : 1e-3, method.dt_max_s);
    const bool adaptive = method.tolerance_um > 0.0;
    if (adaptive && !(method.dt_min_s <= method.dt_s && method.dt_s <= method.dt_max_s))
        throw Error(
            method.loc.line > 0 ? method.loc : Loc{scene.file, 0, 0},
            fmt::format("method: dt ({} s) must lie between dt_min ({} s) and dt_max ({} s)",
                        method.dt_s, method.dt_min_s, method.dt_max_s));
    if (!scene.cytosol || scene.cytosol->controller != VolumeController::pid) return;
    Cytosol& cytosol = *scene.cytosol;
    if (!draft.given("cytosol.T_I")) {
        if (!zeta_s)
            throw Error(cytosol.loc,
                        "cytosol.T_I is missing; its default needs [cortex.tension] and "
                        "[cortex.viscosity]",
                        "typical: 0.115 s");
        cytosol.T_I_s = *zeta_s;
    }
    if (!draft.given("cytosol.T_d")) cytosol.T_d_s = 10.0 * cytosol.T_I_s;
}

// ---- loads, stages, pictures, expectations
// -------------------------------------------------------

void check_surroundings(const Draft& draft) {
    const Scene& scene = draft.scene;
    if (!scene.medium)
        throw Error(Loc{scene.file, 0, 0},
                    "the table [medium] is missing: without drag the velocities of cells are not "
                    "defined",
                    "[medium] with eta_f = \"0.05 kPa s\" is the paper's");
    if (scene.body_force && scene.body_force->opposed && scene.cells.count != 2 &&
        scene.cells.arrangement != Arrangement::file)
        throw Error(
            loc_of(draft, "load.body_force.opposed"),
            fmt::format("load.body_force.opposed wants two cells, got {}", scene.cells.count));
}

/// A stage is computed on the mesh of the cells unless it names a coarser one: the scene then also
/// works with coarser cells.
void resolve_stage_meshes(Draft& draft) {
    Scene& scene = draft.scene;
    for (std::size_t k = 0; k < scene.stages.size(); ++k) {
        Stage& stage = scene.stages[k];
        if (stage.nodes == 0 || stage.nodes > scene.cells.nodes) stage.nodes = scene.cells.nodes;
        if (k > 0 && stage.nodes < scene.stages[k - 1].nodes)
            throw Error(stage.loc,
                        fmt::format("stage.nodes = {} is coarser than the {} of the stage before",
                                    stage.nodes, scene.stages[k - 1].nodes),
                        "cells can be carried over to a finer mesh only");
    }
    if (!scene.stages.empty() && scene.stages.back().nodes != scene.cells.nodes)
        throw Error(scene.stages.back().loc,
                    fmt::format("the last stage has {} nodes per cell, cells.nodes is {}",
                                scene.stages.back().nodes, scene.cells.nodes),
                    "results are those of the mesh of cells.nodes: leave stage.nodes away here");
    if (scene.cells.arrangement == Arrangement::file && !scene.stages.empty() &&
        scene.stages.front().nodes != scene.cells.nodes)
        throw Error(scene.stages.front().loc, "cells from a file start on the mesh of cells.nodes");
}

/// What an indentation takes from the rest of the scene, and what cannot be one.
void resolve_indentation(Draft& draft) {
    Scene& scene = draft.scene;
    for (std::size_t k = 0; k < scene.stages.size(); ++k) {
        Stage& stage = scene.stages[k];
        if (stage.kind != StageKind::indent) continue;
        if (!scene.contact)
            throw Error(stage.loc, "indent needs [contact]: cells without it would be pressed "
                                   "through each other");
        if (k + 1 < scene.stages.size())
            throw Error(stage.loc, "a stage of kind \"indent\" must be the last one: hull and "
                                   "probe stay");
        if (stage.until == Until::stationary)
            throw Error(stage.loc, "an indentation ends after its duration or at rest, not "
                                   "\"stationary\"");
        const std::string path = fmt::format("stage[{}].", k);
        if (!draft.given(path + "hull_gap")) stage.hull_gap_um = scene.contact->h0_um;
        if (stage.hull_gap_um < 0.0)
            throw Error(loc_of(draft, path + "hull_gap"),
                        fmt::format("stage.hull_gap = {} um: the hull would not contain the cells",
                                    stage.hull_gap_um),
                        "it wants 0 um or more; contact.h0 is usual");
        if (stage.clearance_um < 0.0)
            throw Error(loc_of(draft, path + "clearance"),
                        fmt::format("stage.clearance = {} um: the probe would start inside the "
                                    "cells",
                                    stage.clearance_um),
                        "it wants 0 um or more");
        const auto& [x, y, z] = stage.direction;
        if (!(x * x + y * y + z * z > 0.0))
            throw Error(loc_of(draft, path + "direction"),
                        "stage.direction wants a vector that is not zero");
        stage.probe_friction_nN_s_per_um = stage.probe_drag * 6.0 * std::numbers::pi *
                                           scene.medium->eta_f_kPa_s * stage.probe_radius_um;
    }
}

void check_stages(const Draft& draft) {
    const Scene& scene = draft.scene;
    const bool packs = scene.cells.arrangement == Arrangement::packing;
    if (scene.stages.empty())
        throw Error(Loc{scene.file, 0, 0}, "the scene has no [[stage]]: nothing would happen");
    if (packs && scene.stages.front().kind != StageKind::anneal)
        throw Error(scene.stages.front().loc,
                    "arrangement = \"packing\" wants a stage of kind \"anneal\" first, which packs "
                    "the beads");
    bool wall = false;
    for (std::size_t k = 0; k < scene.stages.size(); ++k) {
        const Stage& stage = scene.stages[k];
        const bool needs_wall = stage.kind == StageKind::hold || stage.kind == StageKind::release;
        if (stage.kind == StageKind::anneal && (!packs || k > 0))
            throw Error(stage.loc, packs ? "a stage of kind \"anneal\" can only be the first"
                                         : "a stage of kind \"anneal\" packs beads: it belongs to "
                                           "arrangement = \"packing\"");
        if ((needs_wall || stage.kind == StageKind::compact) && !scene.contact)
            throw Error(stage.loc, "compact, hold and release need [contact]: cells without it "
                                   "would be pressed through each other");
        if (needs_wall && !wall)
            throw Error(stage.loc, fmt::format("a stage of kind \"{}\" must follow \"compact\" or "
                                               "\"hold\": there is no wall",
                                               stage.kind == StageKind::hold ? "hold" : "release"));
        if (wall && !needs_wall)
            throw Error(stage.loc, "the wall is still there: a stage of kind \"release\" must come "
                                   "before this one");
        wall = stage.kind == StageKind::compact || stage.kind == StageKind::hold;
    }
}

bool is_file_name(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
}

void check_start(const Draft& draft) {
    if (!draft.scene.start) return;
    const auto& [x, y, z] = draft.scene.start->turn_axis;
    if (!(x * x + y * y + z * z > 0.0))
        throw Error(loc_of(draft, "start.turn_axis"),
                    "start.turn_axis wants a vector that is not zero");
}

void resolve_pictures(Draft& draft) {
    Scene& scene = draft.scene;
    std::vector<std::string>& fields = scene.measures.fields;
    const auto has_field = [&](const std::string& name) {
        return std::find(fields.begin(), fields.end(), name) != fields.end();
    };
    if (std::set<std::string>(fields.begin(), fields.end()).size() != fields.size())
        throw Error(loc_of(draft, "measures.fields"), "measures.fields names a field twice");
    std::set<std::string> names;
    for (const Picture& picture : scene.pictures) {
        if (!is_file_name(picture.name))
            throw Error(picture.loc,
                        fmt::format("a picture's name is made of letters, digits, '_' and '-', as "
                                    "it names files; got \"{}\"",
                                    picture.name));
        if (picture.name == "all")
            throw Error(picture.loc,
                        "no picture can be named \"all\": --picture all means each one");
        if (!names.insert(picture.name).second)
            throw Error(picture.loc,
                        fmt::format("two pictures have the name \"{}\"", picture.name));
        if (picture.network && !scene.contact)
            throw Error(picture.loc, "picture.network draws contact forces: it needs [contact]");
        if (picture.range == "given")
            if (const std::string problem = problem_of_range(picture.given_range); !problem.empty())
                throw Error(picture.loc, problem);
        static_cast<void>(parse_shots(picture));  // throws for a shot that nobody understands
        if (picture.stress_axes && !scene.contact)
            throw Error(picture.loc,
                        "picture.stress_axes draws contact stress: it needs [contact]");
        if (!picture.field.empty() && !has_field(picture.field)) fields.push_back(picture.field);
        if (picture.stress_axes)
            for (const std::string_view name : k_stress_components)
                if (!has_field(std::string(name))) fields.emplace_back(name);
    }
}

void check_measures(const Draft& draft) {
    const Scene& scene = draft.scene;
    if (scene.measures.mesh_error && scene.cells.nodes == 42)
        throw Error(
            loc_of(draft, "measures.mesh_error"),
            "measures.mesh_error wants a coarser mesh to compare with, and cells.nodes = 42 "
            "is the coarsest",
            "cells.nodes = 162 has one");
    if (scene.measures.mesh_error && scene.cells.arrangement == Arrangement::file)
        throw Error(loc_of(draft, "measures.mesh_error"),
                    "measures.mesh_error cannot be had for cells from a file",
                    "they are there on one mesh only");
}

void resolve_expect(Draft& draft) {
    for (std::size_t k = 0; k < draft.scene.expect.size(); ++k) {
        Expect& expect = draft.scene.expect[k];
        const Draft::ExpectedValue& form = draft.expected_values[k];
        const bool bounds = std::isfinite(expect.min) || std::isfinite(expect.max);
        const bool one_width = form.tolerance.has_value() != form.relative.has_value();
        const bool by_value = form.value && one_width;
        if (bounds == by_value || (bounds && (form.value || form.tolerance || form.relative)))
            throw Error(expect.loc, fmt::format("expect.{} wants min and max (or one of them), or "
                                                "value with tolerance or relative",
                                                expect.measure));
        if (by_value) {
            const double width =
                form.tolerance ? *form.tolerance : *form.relative * std::abs(*form.value);
            expect.min = *form.value - width;
            expect.max = *form.value + width;
        }
        if (!(expect.min <= expect.max))
            throw Error(expect.loc, fmt::format("expect.{}: min ({}) is above max ({})",
                                                expect.measure, expect.min, expect.max));
    }
}

}  // namespace

void resolve(Draft& draft) {
    if (draft.scene.title.empty())
        draft.scene.title = std::filesystem::path(draft.scene.file).stem().string();
    resolve_cells(draft);
    resolve_contact(draft);
    resolve_elastic(draft);
    resolve_regularisation(draft);
    resolve_times(draft);
    check_surroundings(draft);
    check_stages(draft);
    check_start(draft);
    resolve_indentation(draft);
    resolve_stage_meshes(draft);
    check_measures(draft);
    resolve_pictures(draft);
    resolve_expect(draft);
}

}  // namespace spheroscope::scene
