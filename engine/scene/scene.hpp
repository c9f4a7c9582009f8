#pragma once

#include "engine/base/error.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// A scene as plain typed values in the engine's units (um, s, nN; so kPa = nN/um^2, fJ = nN um). A
// table that is present in the file is a part that is present in the run: `optional` members are
// parts, and no default adds physics. Every part keeps the place of its table for later messages.
namespace spheroscope::scene {

/// Radii of the cells: all equal, or gamma-distributed and truncated (Cuvelier et al. 2021,
/// Table 2).
struct Radius {
    std::optional<double> fixed_um;  ///< all cells; then the rest of this struct is unused
    double shape = 37.75;
    double scale_um = 0.24;
    double min_um = 5.0;
    double max_um = 13.0;
};

enum class Arrangement { packing, single, pair, centres, file };

struct Cells {
    Loc loc;
    Arrangement arrangement = Arrangement::packing;
    int count = 0;    ///< resolved for all but `file`, which says it itself: 0
    int nodes = 162;  ///< per cell: 42, 162, 642, 2562; `file`: must agree
    Radius radius;
    double gap_um = 0.2;                            ///< pair: between the two spheres
    std::vector<std::array<double, 4>> centres_um;  ///< centres: rows of x, y, z, radius
    std::string file;  ///< file: HDF5 run whose frame is the start, relative to
                       ///< the scene
    int frame = -1;    ///< file: -1 is the last
};

struct Elastic {  // eqn (8)
    Loc loc;
    double E_kPa = 0.0;
};
struct Bending {  // eqns (9), (10)
    Loc loc;
    double E_kPa = 0.0;  ///< resolved: [cortex.bending] E, or that of [cortex.elastic]
    double poisson = 1.0 / 3.0;
    double factor = 1.0;  ///< k_bend = factor * E t^3 / 12(1 - nu^2); 2/sqrt(3) gives D_eff = D
};
struct Tension {  // eqn (11)
    Loc loc;
    double gamma_nN_per_um = 0.0;
};
struct Viscosity {  // eqns (15), (16)
    Loc loc;
    double eta_kPa_s = 0.0;
};
/// Strain limiter and fold stop for soft cells; not in the paper.
struct Regularisation {
    Loc loc;
    double kappa_nN_per_um = 0.0;  ///< resolved: given, or max(0, gamma/2 - E t)
    double psi0 = 0.1;
    double fold_angle_rad = 1.5707963267948966;
};
struct Cortex {
    double thickness_um = 0.2;
    std::optional<Elastic> elastic;
    std::optional<Bending> bending;
    std::optional<Tension> tension;
    std::optional<Viscosity> viscosity;
    std::optional<Regularisation> regularisation;
};

enum class VolumeController { pid, proportional, exact };

struct Cytosol {  // eqns (12), (13)
    Loc loc;
    VolumeController controller = VolumeController::pid;
    double K_kPa = 5.0;
    double T_I_s = 0.0;               ///< pid: resolved, default c / 2 gamma (see 'Departures')
    double T_d_s = 0.0;               ///< pid: resolved, default 10 T_I
    double extra_pressure_kPa = 0.0;  ///< constant, on top of the offset pressure
    double target_strain = 0.0;       ///< V* = (1 + this) * initial volume
};

struct Medium {  // eqn (14)
    Loc loc;
    double eta_f_kPa_s = 0.05;
};

enum class ContactLaw { traction, variational };
enum class Precision { single_precision, double_precision };
enum class OmegaReading { printed, text, two_sided, per_cell, work_of_adhesion };

struct Contact {  // eqns (5)-(7)
    Loc loc;
    ContactLaw law = ContactLaw::traction;
    Precision precision = Precision::single_precision;  ///< of the geometry of a pair of triangles
    double reject_cos = 0.0;  ///< traction: a pair is skipped when n_A . n_B >= this
    double h0_um = 0.3;
    bool allow_coarse_mesh = false;  ///< h0 below a twentieth of an edge is an error without it
    OmegaReading omega_reading = OmegaReading::text;
    double omega_nN_per_um = 0.0;       ///< as given; 0 with reading work_of_adhesion
    double W_nN_per_um = 0.0;           ///< resolved work of adhesion
    double equilibrium_overlap_h0 = 2;  ///< delta_eq / h0: 1 or 2
    bool adhesive = true;               ///< false: without [contact.adhesion]; then only repulsion
    double repulsion_k_kPa_per_um = 0;  ///< without adhesion: stiffness per area
    std::optional<double> friction_normal_kPa_s_per_um;  ///< [contact.friction], eqns (17), (18)
    std::optional<double> friction_tangential_kPa_s_per_um;
    Loc friction_loc;
};

/// Changes the configuration that [cells] gives, in this order; for tests of robustness and for
/// motions that begin out of equilibrium.
struct Start {
    Loc loc;
    std::array<double, 3> stretch{1.0, 1.0, 1.0};  ///< of each cell about its centre, along x, y, z
    double sliver_height_um = 0.0;  ///< > 0: the first triangle of each cell is made so low
    double turn_rad = 0.0;          ///< of everything about turn_axis through the origin
    std::array<double, 3> turn_axis{0.0, 0.0, 1.0};
    std::array<double, 3> shift_um{};  ///< of everything
};

/// Constant force on each cell, spread by rest area; sums to zero over a pair if `opposed`.
struct BodyForce {
    Loc loc;
    std::array<double, 3> force_nN{};
    bool opposed = false;  ///< cell 0 gets +force, cell 1 gets -force
};

/// Forces that `cells.file` holds for the nodes of its cells, constant in time, and the integrals
/// of their volume controllers at the start.
struct Held {
    Loc loc;
};

enum class StableStep { refuse, follow, ignore };

struct Method {
    Loc loc;
    std::string name = "linearly_implicit";  ///< a row of the methods table
    double dt_s = 0.0;  ///< forward_euler: the step; linearly_implicit: the first
                        ///< one; resolved, default the paper's zeta / 30, or 1 ms
    double dt_max_s = 1.0;
    double dt_min_s = 1e-6;
    double tolerance_um = 0.006;         ///< local error per step; 0: fixed steps of dt
    double displacement_bound_h0 = 0.5;  ///< largest node displacement per step over h0 (contacts)
    double linear_tolerance = 1e-3;
    StableStep stable_step = StableStep::refuse;  ///< forward_euler
};

enum class StageKind { anneal, compact, hold, release, relax, indent };
enum class Until { duration, rest, stationary };
enum class ProbeLaw { linear, hertz };

struct Stage {
    Loc loc;
    StageKind kind = StageKind::relax;
    double duration_s = 0.0;        ///< all but anneal; for `relax` with until = rest: unused
    Until until = Until::duration;  ///< relax, indent
    double cap_s = 120.0;           ///< until rest/stationary: longest time
    double every_s = 0.0;           ///< output interval, model time; 0: only at its end
    int nodes = 0;                  ///< mesh that it is computed on; resolved: never 0
    // anneal
    int steps = 20000;
    double packing_fraction = 0.60;
    int frames = 0;  ///< anneal: frames spread over its steps (0: none)
    // compact
    double volume_fraction = 0.97;      ///< stops here at the latest
    double contact_rate_per_s = 0.005;  ///< or when the contact fraction rises slower
    double wall_stiffness = 10.0;       ///< over the contact stiffness k; indent: of hull and probe
    // indent
    double force_nN = 15.0;
    double probe_radius_um = 27.0;
    ProbeLaw probe_law = ProbeLaw::linear;
    double probe_modulus_kPa = 0.0;                   ///< E* of `hertz`
    std::array<double, 3> direction{0.0, 0.0, -1.0};  ///< in which the probe is pushed
    double clearance_um = 0.0;                        ///< of the probe at the start
    double probe_drag = 1.0;                          ///< friction of the probe over that of Stokes
    double probe_friction_nN_s_per_um = 0.0;          ///< resolved
    double hull_gap_um = 0.0;                         ///< resolved: given, or h0
    double opening = 1.2;                             ///< of the hull, over the probe's radius
};

struct Measures {
    Loc loc;
    std::vector<std::string> fields;  ///< rows of the table of fields, evaluated at output times;
                                      ///< resolved: with those that pictures show
    double touching_area_um2 = 0.1;   ///< a pair of cells touches above this contact area
    bool time_error = false;          ///< run once more with half the steps, for the estimate
    bool mesh_error = false;          ///< run once more on the next coarser mesh, for the estimate
};

/// One view of the spheroid; the first one is what `movie` shows.
/// The fields that hold the stress of cells component by component: xx, yy, zz, xy, xz, yz.
inline constexpr std::array<std::string_view, 6> k_stress_components{
    "stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_xz", "stress_yz"};

struct Picture {
    Loc loc;
    std::string name = "main";
    std::string field;  ///< empty: plain cells
    std::array<int, 2> size_px{1280, 720};
    std::string range = "run";                    ///< "run", "frame" or "given"
    std::array<double, 2> given_range{0.0, 0.0};  ///< in the field's shown unit
    bool cutaway = false;                         ///< leave out whole cells on the near side
    bool network = false;                         ///< draw the contact-force network
    bool stress_axes = false;                     ///< draw the principal axes of cells' stress
    double exploded = 0.0;                        ///< cells moved outward by this share
    double azimuth_deg = 30.0, elevation_deg = 20.0;
    double orbit_deg = 0.0;  ///< turned over the whole movie
    double fps = 30.0;
    bool smooth = true;              ///< drawn at twice the size, then averaged
    std::string plot;                ///< a row of all_totals() below the picture; empty: no plot
    std::vector<std::string> shots;  ///< engine/scene/shots.hpp; empty: every frame once
};

/// A bound that the end of the run must meet: [expect] name = { value, tolerance } or { min, max }.
struct Expect {
    Loc loc;
    std::string measure;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
};

enum class StabilityOutcome { ends, stops, either };

/// What a method, or a class of methods, must do with the scene: [stability.<methods>].
struct Stability {
    Loc loc;
    std::string methods;  ///< a row of the methods table, "explicit", "implicit" or "all"
    StabilityOutcome outcome = StabilityOutcome::ends;
    std::vector<std::string> names;  ///< words that the reason of a stop contains
    double within_s = 0.0;           ///< model time of a stop at the latest; 0: any
    double largest_step_h0 = 0.0;    ///< bound on a node's displacement per step; 0: none
    double forces_kept = 0.0;        ///< bound on the change of forces by [start]; 0: none
    double pull_off = 0.0;           ///< bound on the pull-off work over W, less 1; 0: none
};

/// The scene with some keys changed, under a name.
struct Variant {
    Loc loc;
    std::string name;
    std::vector<std::string> set;  ///< "key=value"
};

struct Scene {
    std::string file;  ///< as opened
    std::string title;
    std::uint64_t seed = 1;
    bool allow_full_wetting = false;  ///< W > 2 gamma is an error without it
    Cells cells;
    std::optional<Start> start;
    Cortex cortex;
    std::optional<Cytosol> cytosol;
    std::optional<Medium> medium;
    std::optional<Contact> contact;
    std::optional<BodyForce> body_force;
    std::optional<Held> held;
    Method method;
    std::vector<Stage> stages;
    Measures measures;
    std::vector<Picture> pictures;
    std::vector<Expect> expect;
    std::vector<Stability> stability;
    std::vector<Variant> variants;
    std::vector<std::string> warnings;  ///< e.g. W = 2 gamma, with its place; to be shown once
    std::string resolved_toml;          ///< canonical text of everything above that applies
};

/// Command-line overrides: "contact.adhesion.omega=0.5 nN/um", "cells.nodes=642",
/// "stage[2].cap=60 s". The value is a TOML value if it parses as one, else bare text. Where keys
/// exclude each other (E and Et_over_omega), an override replaces the others of the file.
struct Override {
    std::string key, value;
};

/// Reads, checks and resolves a scene. Throws Error with file:line:column for the first mistake.
[[nodiscard]] Scene load_scene(const std::string& path,
                               const std::vector<Override>& overrides = {});
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& name,
                                const std::vector<Override>& overrides = {});

/// The same scene with cells of another mesh: stages on the cells' own mesh go with it, those on a
/// coarser one stay there, and none is finer than the cells.
[[nodiscard]] Scene on_mesh(const Scene& scene, int nodes);

/// The documentation of all keys as Markdown (scenes/README.md between its markers), from the key
/// table.
[[nodiscard]] std::string keys_markdown();

}  // namespace spheroscope::scene
