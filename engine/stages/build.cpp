#include "engine/stages/build.hpp"

#include "engine/base/index.hpp"
#include "engine/base/random.hpp"
#include "engine/forces/active_tension.hpp"
#include "engine/forces/bending.hpp"
#include "engine/forces/body_force.hpp"
#include "engine/forces/compaction_wall.hpp"
#include "engine/forces/contact_traction.hpp"
#include "engine/forces/contact_variational.hpp"
#include "engine/forces/fold_stop.hpp"
#include "engine/forces/held_force.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/forces/strain_limiter.hpp"
#include "engine/friction/cortex_viscosity.hpp"
#include "engine/stages/start_changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope {
namespace {

/// Uniform random rotation of cell c (Shoemake 1992).
Mat3 random_rotation(std::uint64_t seed, int cell) {
    const Random random(seed, static_cast<std::uint32_t>(RandomStream::orientation));
    const auto index = static_cast<std::uint64_t>(cell);
    const double u = random.uniform(index, 0);
    const double a = 2.0 * std::numbers::pi * random.uniform(index, 1);
    const double b = 2.0 * std::numbers::pi * random.uniform(index, 2);
    const Eigen::Quaterniond q(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                               std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b));
    return q.toRotationMatrix();
}

/// The first stage of this kind, or nullptr.
const scene::Stage* find_stage(const scene::Scene& scene, scene::StageKind kind) {
    const auto found = std::find_if(scene.stages.begin(), scene.stages.end(),
                                    [&](const scene::Stage& stage) { return stage.kind == kind; });
    return found == scene.stages.end() ? nullptr : &*found;
}

ContactLaw contact_law(const scene::Contact& contact) {
    ContactLaw law =
        contact.adhesive
            ? adhesive_law(contact.W_nN_per_um, contact.h0_um, contact.equilibrium_overlap_h0,
                           contact.reject_cos)
            : repulsive_law(contact.repulsion_k_kPa_per_um, contact.h0_um, contact.reject_cos);
    if (contact.law == scene::ContactLaw::variational) law.form = ContactForm::variational;
    return law;
}

/// Stiffness per area of what a stage puts around the cells: a multiple of the contacts' own.
double wall_stiffness_kPa_per_um(const scene::Scene& scene, const scene::Stage& stage) {
    return stage.wall_stiffness * contact_law(*scene.contact).k_kPa_per_um;
}

void place_unturned(const Model& model, int cell, const Vec3& centre_um, std::span<Vec3> x_um) {
    const std::span<Vec3> x = model.cell_nodes(x_um, cell);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = centre_um + model.radius_um[idx(cell)] * model.topology->unit_shape[i];
}

void check_given(const scene::Scene& scene, const Model& model, const GivenCells& given) {
    const auto fail = [&](const std::string& what) {
        throw Error(scene.cells.loc, "the cells of " + scene.cells.file + " " + what,
                    "start from a frame of a run that ended well");
    };
    if (given.n_nodes != scene.cells.nodes)
        fail("have " + std::to_string(given.n_nodes) + " nodes, cells.nodes wants " +
             std::to_string(scene.cells.nodes));
    if (scene.held && (!given.held || given.held->force_nN.size() != model.n_all_nodes() ||
                       given.held->volume_integral_s.size() != model.radius_um.size()))
        throw Error(scene.held->loc,
                    "[load.held]: " + scene.cells.file + " holds no forces for these cells",
                    "files that `extract` has written hold some");
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const auto x = model.cell_nodes(std::span<const Vec3>(given.x_um), cell);
        for (const Vec3& node : x)
            if (!node.allFinite()) fail("are not all finite (cell " + std::to_string(cell) + ")");
        if (enclosed_volume(model.topology->triangles, x) <= 0.0)
            fail("are inside out (cell " + std::to_string(cell) + ")");
    }
}

}  // namespace

std::vector<double> cell_radii(const scene::Scene& scene, const std::optional<GivenCells>& given) {
    const scene::Cells& cells = scene.cells;
    if (cells.arrangement == scene::Arrangement::file) {
        if (!given)
            throw Error(cells.loc, "cells from a file cannot be had here",
                        "`run` and the verbs that show runs begin with such cells");
        return given->radius_um;
    }
    if (cells.arrangement == scene::Arrangement::centres) {
        std::vector<double> radii;
        for (const auto& row : cells.centres_um) radii.push_back(row[3]);
        return radii;
    }
    if (cells.radius.fixed_um) return std::vector<double>(idx(cells.count), *cells.radius.fixed_um);
    return draw_radii(
        {cells.radius.shape, cells.radius.scale_um, cells.radius.min_um, cells.radius.max_um},
        cells.count, scene.seed);
}

void check_centres(const scene::Scene& scene) {
    if (scene.cells.arrangement != scene::Arrangement::centres) return;
    const auto& rows = scene.cells.centres_um;  // x, y, z, radius
    for (std::size_t a = 0; a < rows.size(); ++a)
        for (std::size_t b = a + 1; b < rows.size(); ++b) {
            const Vec3 between_um(rows[a][0] - rows[b][0], rows[a][1] - rows[b][1],
                                  rows[a][2] - rows[b][2]);
            const double overlap_um = rows[a][3] + rows[b][3] - between_um.norm();
            if (overlap_um > std::min(rows[a][3], rows[b][3]))
                throw Error(scene.cells.loc,
                            "cells.centres: cells " + std::to_string(a) + " and " +
                                std::to_string(b) + " overlap by " + std::to_string(overlap_um) +
                                " um, more than a radius",
                            "move their centres apart; no contact law can undo that");
        }
}

std::vector<Vec3> start_positions(const scene::Scene& scene, const Model& model,
                                  const std::optional<GivenCells>& given) {
    std::vector<Vec3> x_um(model.n_all_nodes(), Vec3::Zero());
    switch (scene.cells.arrangement) {
    case scene::Arrangement::packing: break;  // the anneal stage places them
    case scene::Arrangement::single: place_unturned(model, 0, Vec3::Zero(), x_um); break;
    case scene::Arrangement::pair: {
        // The gap is between the spheres on which the nodes lie. Both cells keep the orientation of
        // the rest shape, so a doublet is the same whatever the seed.
        const double node_radius = model.topology->unit_shape[0].norm();
        const double half_um =
            0.5 * (node_radius * (model.radius_um[0] + model.radius_um[1]) + scene.cells.gap_um);
        place_unturned(model, 0, Vec3(0.0, 0.0, -half_um), x_um);
        place_unturned(model, 1, Vec3(0.0, 0.0, half_um), x_um);
        break;
    }
    case scene::Arrangement::centres: {
        std::vector<Vec3> centre_um;
        for (const auto& row : scene.cells.centres_um)
            centre_um.emplace_back(row[0], row[1], row[2]);
        check_centres(scene);
        place_cells(model, centre_um, scene.seed, x_um);
        break;
    }
    case scene::Arrangement::file:
        check_given(scene, model, given.value());
        x_um = given->x_um;
        break;
    }
    if (scene.start) change_start(*scene.start, model, x_um);
    return x_um;
}

void place_cells(const Model& model, std::span<const Vec3> centre_um, std::uint64_t seed,
                 std::span<Vec3> x_um) {
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const Mat3 rotation = random_rotation(seed, cell);
        const std::span<Vec3> x = model.cell_nodes(x_um, cell);
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = centre_um[idx(cell)] +
                   model.radius_um[idx(cell)] * (rotation * model.topology->unit_shape[i]);
    }
}

SystemParts build_parts(const scene::Scene& scene, std::span<const Vec3> held_force_nN) {
    SystemParts parts;
    const double t_um = scene.cortex.thickness_um;
    const auto add = [&](auto term) {
        const auto* raw = term.get();
        parts.terms.push_back(std::move(term));
        return raw;
    };
    if (const auto& p = scene.cortex.elastic)
        add(std::make_unique<InPlaneElasticity>(p->loc,
                                                InPlaneElasticityParameters{p->E_kPa, t_um}));
    if (const auto& p = scene.cortex.bending)
        add(std::make_unique<Bending>(p->loc,
                                      BendingParameters{p->E_kPa, t_um, p->poisson, p->factor}));
    if (const auto& p = scene.cortex.tension)
        add(std::make_unique<ActiveTension>(p->loc, ActiveTensionParameters{p->gamma_nN_per_um}));
    if (const auto& p = scene.cortex.regularisation; p && p->kappa_nN_per_um > 0.0) {
        add(std::make_unique<StrainLimiter>(p->loc,
                                            StrainLimiterParameters{p->kappa_nN_per_um, p->psi0}));
        add(std::make_unique<FoldStop>(p->loc,
                                       FoldStopParameters{p->kappa_nN_per_um, p->fold_angle_rad}));
    }
    if (const auto& p = scene.cytosol) {
        const bool is_pid = p->controller == scene::VolumeController::pid;
        CytosolPressureParameters cytosol{
            p->K_kPa, is_pid ? p->T_I_s : std::numeric_limits<double>::infinity(),
            is_pid ? p->T_d_s : 0.0, p->extra_pressure_kPa,
            scene.cortex.tension ? scene.cortex.tension->gamma_nN_per_um : 0.0};
        if (p->controller == scene::VolumeController::exact) {
            cytosol.is_exact = true;
            cytosol.K_kPa = cytosol.T_I_s = 1.0;  // the unit of the multiplier
        }
        parts.cytosol = add(std::make_unique<CytosolPressure>(p->loc, cytosol));
    }
    if (const auto& p = scene.contact) {
        parts.contact = contact_law(*p);
        parts.contact_precision = p->precision == scene::Precision::single_precision
                                      ? ContactPrecision::single_precision
                                      : ContactPrecision::double_precision;
        if (parts.contact->form == ContactForm::variational)
            add(std::make_unique<ContactVariational>(p->loc));
        else
            add(std::make_unique<ContactTraction>(p->loc));
        if (p->friction_normal_kPa_s_per_um)
            parts.frictions.contact = ContactFriction{*p->friction_normal_kPa_s_per_um,
                                                      *p->friction_tangential_kPa_s_per_um};
    }
    if (const auto& p = scene.body_force)
        parts.body_force = add(std::make_unique<BodyForce>(
            p->loc,
            BodyForceParameters{Vec3(p->force_nN[0], p->force_nN[1], p->force_nN[2]), p->opposed}));
    if (const auto& p = scene.held)
        add(std::make_unique<HeldForce>(
            p->loc, std::vector<Vec3>(held_force_nN.begin(), held_force_nN.end())));
    if (const auto* stage = find_stage(scene, scene::StageKind::compact))
        parts.wall = add(std::make_unique<CompactionWall>(
            stage->loc, CompactionWallParameters{wall_stiffness_kPa_per_um(scene, *stage)}));
    if (const auto* stage = find_stage(scene, scene::StageKind::indent)) {
        const double k_kPa_per_um = wall_stiffness_kPa_per_um(scene, *stage);
        parts.hull =
            add(std::make_unique<ConfiningHull>(stage->loc, ConfiningHullParameters{k_kPa_per_um}));
        const bool is_hertz = stage->probe_law == scene::ProbeLaw::hertz;
        parts.probe = add(std::make_unique<IndentingProbe>(
            stage->loc, IndentingProbeParameters{.k_kPa_per_um = k_kPa_per_um,
                                                 .hertz_modulus_kPa =
                                                     is_hertz ? stage->probe_modulus_kPa : 0.0}));
    }
    if (scene.medium) parts.frictions.eta_f_kPa_s = scene.medium->eta_f_kPa_s;
    if (const auto& p = scene.cortex.viscosity)
        parts.frictions.edge_nN_s_per_um = edge_friction_nN_s_per_um(p->eta_kPa_s, t_um);
    return parts;
}

MethodParameters method_parameters(const scene::Scene& scene) {
    const scene::Method& m = scene.method;
    MethodParameters p;
    p.dt_s = m.dt_s;
    p.dt_max_s = m.dt_max_s;
    p.dt_min_s = m.dt_min_s;
    p.tolerance_um = m.tolerance_um;
    // Without contacts nothing limits a displacement but the error.
    p.displacement_bound_um = scene.contact ? m.displacement_bound_h0 * scene.contact->h0_um
                                            : std::numeric_limits<double>::infinity();
    p.linear_tolerance = m.linear_tolerance;
    switch (m.stable_step) {
    case scene::StableStep::refuse: p.stable_step = StableStep::refuse; break;
    case scene::StableStep::follow: p.stable_step = StableStep::follow; break;
    case scene::StableStep::ignore: p.stable_step = StableStep::ignore; break;
    }
    p.loc = m.loc;
    return p;
}

BeadPackingParameters packing_parameters(const scene::Stage& stage) {
    BeadPackingParameters p;
    p.packing_fraction = stage.packing_fraction;
    p.steps = stage.steps;
    return p;
}

}  // namespace spheroscope
