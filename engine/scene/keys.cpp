#include "engine/scene/keys.hpp"

#include "engine/scene/keys_access.hpp"
#include "engine/scene/picture_size.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

constexpr std::array<std::string_view, 5> k_arrangements{"packing", "single", "pair", "centres",
                                                         "file"};
constexpr std::array<std::string_view, 3> k_controllers{"pid", "proportional", "exact"};
constexpr std::array<std::string_view, 2> k_laws{"traction", "variational"};
constexpr std::array<std::string_view, 2> k_precisions{"float", "double"};
constexpr std::array<std::string_view, 5> k_readings{"printed", "text", "two_sided", "per_cell",
                                                     "work_of_adhesion"};
constexpr std::array<std::string_view, 6> k_stages{"anneal",  "compact", "hold",
                                                   "release", "relax",   "indent"};
constexpr std::array<std::string_view, 3> k_stable_steps{"refuse", "follow", "ignore"};
constexpr std::array<std::string_view, 2> k_probe_laws{"linear", "hertz"};
constexpr std::array<std::string_view, 3> k_untils{"duration", "rest", "stationary"};
constexpr std::array<std::string_view, 3> k_outcomes{"ends", "stops", "either"};
constexpr std::array<std::string_view, 3> k_ranges{"run", "frame", "given"};

constexpr std::string_view k_table_1 = "Cuvelier et al. 2021, Table 1";
constexpr std::string_view k_table_2 = "Cuvelier et al. 2021, Table 2";
constexpr std::string_view k_appendix_g = "Cuvelier et al. 2021, Appendix G";
constexpr std::string_view k_ours = "chosen here";

constexpr Bound positive{[](double x) { return x > 0.0; }, "> 0"};
constexpr Bound not_negative{[](double x) { return x >= 0.0; }, ">= 0"};
constexpr Bound at_least_one{[](double x) { return x >= 1.0; }, ">= 1"};
constexpr Bound number_of_cells{[](double x) { return x >= 1.0 && x <= 1e5; }, "1 ... 100000"};
constexpr Bound fraction{[](double x) { return x > 0.0 && x < 1.0; }, "between 0 and 1"};
constexpr Bound mesh_size{[](double x) { return x == 42 || x == 162 || x == 642 || x == 2562; },
                          "42, 162, 642 or 2562"};
constexpr Bound last_or_index{[](double x) { return x >= -1.0; }, ">= -1"};
constexpr Bound poisson{[](double x) { return x > -1.0 && x < 0.5; }, "between -1 and 0.5"};
constexpr Bound cosine{[](double x) { return x >= 0.0 && x <= 0.9; }, "0 ... 0.9"};
constexpr Bound one_or_two{[](double x) { return x == 1.0 || x == 2.0; }, "1 or 2"};
constexpr Bound half_turn{[](double x) { return x > 0.0 && x < 3.14159; }, "between 0 and 180 deg"};
constexpr Bound strain{[](double x) { return x > -0.5 && x <= 1.0; }, "above -0.5, at most 1"};
constexpr Bound packing{[](double x) { return x >= 0.1 && x <= 0.64; },
                        "0.1 ... 0.64 (random close packing)"};
constexpr Bound pixels{[](double x) {
                           return x >= k_smallest_side_px && x <= k_largest_side_px &&
                                  std::fmod(x, 2.0) == 0.0;
                       },
                       "even numbers in 64 ... 4096, as movies need them"};
constexpr Bound elevation{[](double x) { return std::abs(x) <= 90.0; }, "-90 ... 90 deg"};
constexpr Bound frame_rate{[](double x) { return x >= 1.0 && x <= 240.0; }, "1 ... 240"};

bool packs(const Draft& d, std::size_t) {
    return d.scene.cells.arrangement == Arrangement::packing;
}
bool makes_spheres(const Draft& d, std::size_t) {
    const Arrangement arrangement = d.scene.cells.arrangement;
    return arrangement != Arrangement::centres && arrangement != Arrangement::file;
}
constexpr Applies with_packing{packs, "with arrangement = \"packing\""};
constexpr Applies without_packing{[](const Draft& d, std::size_t item) { return !packs(d, item); },
                                  "where [cells] gives a configuration, so not with a packing"};
constexpr Applies with_pair{
    [](const Draft& d, std::size_t) { return d.scene.cells.arrangement == Arrangement::pair; },
    "with arrangement = \"pair\""};
constexpr Applies with_centres{
    [](const Draft& d, std::size_t) { return d.scene.cells.arrangement == Arrangement::centres; },
    "with arrangement = \"centres\""};
constexpr Applies with_file{
    [](const Draft& d, std::size_t) { return d.scene.cells.arrangement == Arrangement::file; },
    "with arrangement = \"file\""};
// One key, two forms: a length is the radius of all cells, a table is a distribution. A packing
// without either has the distribution of the paper.
constexpr Applies as_one_radius{[](const Draft& d, std::size_t item) {
                                    const Value* radius = d.document->find("cells.radius");
                                    return makes_spheres(d, item) &&
                                           (radius ? !radius->is_table() : !packs(d, item));
                                },
                                "with arrangement = \"packing\", \"single\" or \"pair\""};
constexpr Applies as_distribution{[](const Draft& d, std::size_t item) {
                                      return makes_spheres(d, item) &&
                                             !as_one_radius.holds(d, item);
                                  },
                                  "with arrangement = \"packing\", \"single\" or \"pair\""};
constexpr Applies with_pid{[](const Draft& d, std::size_t) {
                               return d.scene.cytosol->controller == VolumeController::pid;
                           },
                           "with controller = \"pid\""};
constexpr Applies with_gain{[](const Draft& d, std::size_t) {
                                return d.scene.cytosol->controller != VolumeController::exact;
                            },
                            "with controller = \"pid\" or \"proportional\""};
constexpr Applies with_forward_euler{
    [](const Draft& d, std::size_t) { return d.scene.method.name == "forward_euler"; },
    "with name = \"forward_euler\""};
constexpr Applies with_adhesion{
    [](const Draft& d, std::size_t) { return d.given("contact.adhesion"); },
    "with [contact.adhesion]"};
constexpr Applies with_traction{
    [](const Draft& d, std::size_t) { return d.scene.contact->law == ContactLaw::traction; },
    "with law = \"traction\""};
constexpr Applies without_adhesion{
    [](const Draft& d, std::size_t) { return !d.given("contact.adhesion"); },
    "without [contact.adhesion], which brings its own stiffness"};
constexpr Applies with_W{[](const Draft& d, std::size_t) { return d.given("contact.adhesion.W"); },
                         "with W"};
constexpr Applies without_W{
    [](const Draft& d, std::size_t) { return !d.given("contact.adhesion.W"); }, "without W"};
constexpr Applies with_contact{
    [](const Draft& d, std::size_t) { return d.scene.contact.has_value(); }, "with [contact]"};
constexpr Applies in_anneal{
    [](const Draft& d, std::size_t i) { return d.scene.stages[i].kind == StageKind::anneal; },
    "in a stage of kind \"anneal\""};
constexpr Applies in_compact{
    [](const Draft& d, std::size_t i) { return d.scene.stages[i].kind == StageKind::compact; },
    "in a stage of kind \"compact\""};
constexpr Applies in_indent{
    [](const Draft& d, std::size_t i) { return d.scene.stages[i].kind == StageKind::indent; },
    "in a stage of kind \"indent\""};
constexpr Applies with_hertz{[](const Draft& d, std::size_t i) {
                                 return in_indent.holds(d, i) &&
                                        d.scene.stages[i].probe_law == ProbeLaw::hertz;
                             },
                             "with probe_law = \"hertz\""};
constexpr Applies with_wall{
    [](const Draft& d, std::size_t i) { return in_compact.holds(d, i) || in_indent.holds(d, i); },
    "in a stage of kind \"compact\" or \"indent\""};
constexpr Applies can_rest{[](const Draft& d, std::size_t i) {
                               return d.scene.stages[i].kind == StageKind::relax ||
                                      in_indent.holds(d, i);
                           },
                           "in a stage of kind \"relax\" or \"indent\""};
constexpr Applies in_model_time{
    [](const Draft& d, std::size_t i) { return d.scene.stages[i].kind != StageKind::anneal; },
    "in stages of model time, so not in \"anneal\""};
constexpr Applies for_a_duration{
    [](const Draft& d, std::size_t i) {
        const Stage& stage = d.scene.stages[i];
        return stage.kind != StageKind::anneal && stage.until == Until::duration;
    },
    "in a stage of given length, so not in \"anneal\" nor with until = \"rest\" or \"stationary\""};
constexpr Applies until_quiet{
    [](const Draft& d, std::size_t i) { return d.scene.stages[i].until != Until::duration; },
    "with until = \"rest\" or \"stationary\""};
constexpr Applies with_given_range{
    [](const Draft& d, std::size_t i) { return d.scene.pictures[i].range == "given"; },
    "with range = \"given\""};

using Rule = WhenAbsent::Rule;
constexpr WhenAbsent required{Rule::required, "required"};
constexpr WhenAbsent E_or_ratio{Rule::one_of, "E, Et_over_omega"};
constexpr WhenAbsent ratio_or_E{Rule::input_of, "E, Et_over_omega"};
constexpr WhenAbsent one_adhesion{Rule::one_of, "omega, gamma_over_omega, W"};
constexpr WhenAbsent adhesion_input{Rule::input_of, "omega, gamma_over_omega, W"};
constexpr WhenAbsent expected_input{Rule::optional_input, "value with tolerance or relative"};
constexpr WhenAbsent computed(std::string_view words) { return {Rule::computed, words}; }

// One row in two or three lines; clang-format would take one line for each column.
// clang-format off
const auto& tables() {
    using enum Table::Presence;
    static const std::array rows{
        Table{"scene", standard, nullptr, {}, "What the run is called and its random numbers."},
        Table{"cells", required, &enter<&Scene::cells>, {}, "How many cells, how large, where."},
        Table{"cells.radius", standard, nullptr, as_distribution,
              "Gamma-distributed radii; a draw outside [min, max] is drawn again."},
        Table{"start", part, &enter<&Scene::start>, without_packing,
              "Changes the configuration that [cells] gives, in the order of these keys."},
        Table{"cortex", standard, nullptr, {},
              "The shell of each cell; its parts are tables of their own."},
        Table{"cortex.elastic", part, &enter<&Scene::cortex, &Cortex::elastic>, {},
              "In-plane springs, eqn (8)."},
        Table{"cortex.bending", part, &enter<&Scene::cortex, &Cortex::bending>, {},
              "Bending stiffness of the shell, eqns (9), (10)."},
        Table{"cortex.tension", part, &enter<&Scene::cortex, &Cortex::tension>, {},
              "Active tension of the cortex, eqn (11)."},
        Table{"cortex.viscosity", part, &enter<&Scene::cortex, &Cortex::viscosity>, {},
              "Viscosity of the cortex, eqns (15), (16)."},
        Table{"cortex.regularisation", part, &enter<&Scene::cortex, &Cortex::regularisation>, {},
              "Strain limiter and fold stop for soft cells (they act where E t < gamma / 2); not in "
              "the paper."},
        Table{"cytosol", part, &enter<&Scene::cytosol>, {},
              "Pressure that holds the volume of each cell, eqns (12), (13)."},
        Table{"medium", part, &enter<&Scene::medium>, {},
              "Drag of the surroundings, eqn (14). Every scene needs it: without it the velocities "
              "are not defined."},
        Table{"contact", part, &enter<&Scene::contact>, {},
              "Forces between cells, eqns (5) to (7)."},
        Table{"contact.adhesion", part,
              [](Draft& d, const Loc&, const std::string&) { d.scene.contact->adhesive = true; },
              {},
              "Cells stick to each other. Without this table they only repel."},
        Table{"contact.friction", part,
              [](Draft& d, const Loc& loc, const std::string&) {
                  d.scene.contact->friction_loc = loc;
              },
              {},
              "Friction between touching cells, eqns (17), (18)."},
        Table{"load.body_force", part, &enter<&Scene::body_force>, {},
              "A constant force on each cell, spread by rest area."},
        Table{"load.held", part, &enter<&Scene::held>, with_file,
              "Forces on all nodes, constant in time, which `cells.file` holds: what surroundings "
              "that are gone did at one moment (`extract`)."},
        Table{"method", standard, &enter<&Scene::method>, {}, "How the run is advanced in time."},
        Table{"stage", list, &enter<&Scene::stages>, {},
              "What happens, one after the other. At least one."},
        Table{"measures", standard, &enter<&Scene::measures>, {},
              "What is evaluated at output times."},
        Table{"picture", list, &enter<&Scene::pictures>, {},
              "A view; the first one is what `movie` shows."},
        Table{"expect", named,
              [](Draft& d, const Loc& loc, const std::string& name) {
                  d.scene.expect.push_back({loc, name});
                  d.expected_values.emplace_back();
              }, {},
              "A bound that a measure must meet at the end of the run, in the measure's unit: "
              "`name = { min = 0.1, max = 0.2 }` or `name = { value = 0.11, relative = 0.01 }`."},
        Table{"stability", named,
              [](Draft& d, const Loc& loc, const std::string& name) {
                  d.scene.stability.emplace_back().loc = loc;
                  d.scene.stability.back().methods = name;
              }, {},
              "What `spheroscope stability` expects of the method of that name, or of all methods "
              "that are `explicit` (with fixed steps) or `implicit`, or of `all`; the first that "
              "fits, in this order. What [expect] says holds for every run that comes to its end."},
        Table{"variant", list, &enter<&Scene::variants>, {},
              "The same scene with some keys changed; `spheroscope stability` runs all of them in "
              "place of the scene itself."},
    };
    return rows;
}

// Columns: table, name, member, dimension, bound, when absent, applies, typical, source, meaning.
const auto& keys() {
    using enum Dimension;
    using S = Scene;
    using Co = Cortex;
    static const std::array rows{
        Key{"scene", "title", reach<&S::title>(), number, {}, computed("the file's name"), {}, "",
            "", "Shown in pictures."},
        Key{"scene", "seed", reach<&S::seed>(), number, not_negative, {}, {}, "", "",
            "Of all random numbers."},
        Key{"scene", "allow_full_wetting", reach<&S::allow_full_wetting>(), number, {}, {}, {}, "",
            k_ours,
            "Accept a work of adhesion above 2 gamma, at which cells flatten without limit."},

        Key{"cells", "arrangement", choose<&S::cells, &Cells::arrangement>(k_arrangements), number,
            {}, {}, {}, "", "",
            "Beads packed at random (needs a stage `anneal`), one cell, two cells along z, given "
            "centres, or a frame of a finished run."},
        Key{"cells", "count", reach<&S::cells, &Cells::count>(), number, number_of_cells, required,
            with_packing, "75 ... 600", "Cuvelier et al. 2021, section 2", "Number of cells."},
        Key{"cells", "nodes", reach<&S::cells, &Cells::nodes>(), number, mesh_size, {}, {},
            "162 (quick), 642", k_ours,
            "Nodes of each cell's mesh, a subdivided icosahedron; must agree with `file`."},
        Key{"cells", "radius", reach<&S::cells, &Cells::radius, &Radius::fixed_um>(), length,
            positive, required, as_one_radius, "5 ... 13 um", k_table_2,
            "One radius for all cells, or the table [cells.radius]. A packing without either has "
            "that table."},
        Key{"cells", "gap", reach<&S::cells, &Cells::gap_um>(), length, not_negative, {}, with_pair,
            "0.2 um", k_ours, "Between the two spheres at the start."},
        Key{"cells", "centres", reach<&S::cells, &Cells::centres_um>(), length, {}, required,
            with_centres, "", "", "A row [x, y, z, radius] for each cell."},
        Key{"cells", "file", reach<&S::cells, &Cells::file>(), number, {}, required, with_file, "",
            "", "HDF5 file of a run, relative to the scene."},
        Key{"cells", "frame", reach<&S::cells, &Cells::frame>(), number, last_or_index, {},
            with_file, "-1", "", "Frame of that file; -1 is the last one."},
        Key{"cells.radius", "shape", reach<&S::cells, &Cells::radius, &Radius::shape>(), number,
            positive, {}, {}, "37.75", k_table_2, "Shape of the gamma distribution."},
        Key{"cells.radius", "scale", reach<&S::cells, &Cells::radius, &Radius::scale_um>(), length,
            positive, {}, {}, "0.24 um", k_table_2, "Its scale; the mean is shape * scale."},
        Key{"cells.radius", "min", reach<&S::cells, &Cells::radius, &Radius::min_um>(), length,
            positive, {}, {}, "5 um", k_table_2, "Smallest radius."},
        Key{"cells.radius", "max", reach<&S::cells, &Cells::radius, &Radius::max_um>(), length,
            positive, {}, {}, "13 um", k_table_2, "Largest radius."},

        Key{"start", "stretch", reach<&S::start, &Start::stretch>(), number, positive, {}, {},
            "[1.2, 0.9, 0.9]", k_ours, "Of each cell about its centre, along x, y and z."},
        Key{"start", "sliver_height", reach<&S::start, &Start::sliver_height_um>(), length,
            not_negative, {}, {}, "1e-9 um", k_ours,
            "The first triangle of each cell is made so low; 0: it is left."},
        Key{"start", "turn", reach<&S::start, &Start::turn_rad>(), angle, {}, {}, {}, "37 deg",
            k_ours, "Turns everything about `turn_axis` through the origin."},
        Key{"start", "turn_axis", reach<&S::start, &Start::turn_axis>(), number, {}, {}, {},
            "[0, 0, 1]", k_ours, "Of any length but zero."},
        Key{"start", "shift", reach<&S::start, &Start::shift_um>(), length, {}, {}, {},
            "[1e6, 0, 0]", k_ours, "Moves everything."},

        Key{"cortex", "thickness", reach<&S::cortex, &Co::thickness_um>(), length, positive, {}, {},
            "200 nm", k_table_2, "Thickness t of the shell."},
        Key{"cortex.elastic", "E", reach<&S::cortex, &Co::elastic, &Elastic::E_kPa>(), stiffness,
            positive, E_or_ratio, {}, "0.3125 ... 320 kPa", k_table_2, "Young's modulus."},
        Key{"cortex.elastic", "Et_over_omega", reach<&Draft::Et_over_omega>(), number, positive,
            ratio_or_E, {}, "1/8 ... 64", k_table_1, "Sets E = this * omega / t; needs omega."},
        Key{"cortex.bending", "E", reach<&S::cortex, &Co::bending, &Bending::E_kPa>(), stiffness,
            positive, computed("that of [cortex.elastic]"), {}, "0.3125 ... 320 kPa", k_table_2,
            "Young's modulus for bending."},
        Key{"cortex.bending", "poisson", reach<&S::cortex, &Co::bending, &Bending::poisson>(),
            number, poisson, {}, {}, "1/3", "fixed by the spring network", "Poisson's ratio nu."},
        Key{"cortex.bending", "factor", reach<&S::cortex, &Co::bending, &Bending::factor>(), number,
            positive, {}, {}, "1; 2/sqrt(3) = 1.1547", "Seung & Nelson 1988",
            "k_bend = factor * E t^3 / (12 (1 - nu^2)); 1 is the paper, 1.1547 gives the shell's "
            "own rigidity."},
        Key{"cortex.tension", "gamma", reach<&S::cortex, &Co::tension, &Tension::gamma_nN_per_um>(),
            tension, positive, required, {}, "0.5 nN/um", k_table_2, "Active tension."},
        Key{"cortex.viscosity", "eta", reach<&S::cortex, &Co::viscosity, &Viscosity::eta_kPa_s>(),
            viscosity, positive, required, {}, "1 kPa s", k_table_2, "Viscosity of the cortex."},
        Key{"cortex.regularisation", "kappa",
            reach<&S::cortex, &Co::regularisation, &Regularisation::kappa_nN_per_um>(), tension,
            not_negative, computed("max(0, gamma/2 - E t)"), {}, "0.19 nN/um at E = 0.3125 kPa",
            k_ours, "Strength of the strain limiter."},
        Key{"cortex.regularisation", "psi0",
            reach<&S::cortex, &Co::regularisation, &Regularisation::psi0>(), number, positive, {},
            {}, "0.05 ... 0.1", k_ours,
            "Distortion below which it is silent; 0.1 is about 20 % strain."},
        Key{"cortex.regularisation", "fold_angle",
            reach<&S::cortex, &Co::regularisation, &Regularisation::fold_angle_rad>(), angle,
            half_turn, {}, {}, "75 deg (642 nodes), 90 deg (162)", k_ours,
            "Change of a hinge's angle at which the fold stop sets in."},

        Key{"cytosol", "controller", choose<&S::cytosol, &Cytosol::controller>(k_controllers),
            number, {}, {}, {}, "", "eqn (13)",
            "`pid` reaches the target volume exactly at rest, `proportional` does not, `exact` "
            "keeps it all the time (not every method can)."},
        Key{"cytosol", "K", reach<&S::cytosol, &Cytosol::K_kPa>(), stiffness, not_negative, {},
            with_gain, "5 kPa", k_table_2, "Proportional gain."},
        Key{"cytosol", "T_I", reach<&S::cytosol, &Cytosol::T_I_s>(), time, positive,
            computed("eta t / (2 sqrt(3) gamma)"), with_pid, "0.115 s", k_table_2,
            "Integral time. The default needs [cortex.tension] and [cortex.viscosity]."},
        Key{"cytosol", "T_d", reach<&S::cytosol, &Cytosol::T_d_s>(), time, not_negative,
            computed("10 T_I"), with_pid, "1.15 s", k_table_2, "Derivative time."},
        Key{"cytosol", "extra_pressure", reach<&S::cytosol, &Cytosol::extra_pressure_kPa>(),
            pressure, {}, {}, {}, "0", k_ours,
            "Constant, on top of the pressure that balances gamma at the start."},
        Key{"cytosol", "target_strain", reach<&S::cytosol, &Cytosol::target_strain>(), number,
            strain, {}, {}, "0", k_ours, "Target volume over the initial one, less 1."},
        Key{"medium", "eta_f", reach<&S::medium, &Medium::eta_f_kPa_s>(), viscosity, positive, {},
            {}, "0.05 kPa s", k_table_2, "Viscosity of the medium."},

        Key{"contact", "law", choose<&S::contact, &Contact::law>(k_laws), number, {}, {}, {}, "",
            "eqns (5) to (7)",
            "`traction`: the normal-only force of the paper. `variational`: the gradient of the "
            "contact energy, with its in-plane part."},
        Key{"contact", "precision", choose<&S::contact, &Contact::precision>(k_precisions), number,
            {}, {}, with_traction, "float", k_ours,
            "Of the contact kernel: `float` is two to three times as fast, with errors of the nodal "
            "forces below 1e-5 of the largest."},
        Key{"contact", "reject_cos", reach<&S::contact, &Contact::reject_cos>(), number, cosine, {},
            with_traction, "0, 0.3", k_ours,
            "A pair of triangles is skipped when n_A . n_B is at least this."},
        Key{"contact", "h0", reach<&S::contact, &Contact::h0_um>(), length, positive, {}, {},
            "0.3 um", k_table_2, "Range of adhesion, for each of the two surfaces."},
        Key{"contact", "allow_coarse_mesh",
            reach<&S::contact, &Contact::allow_coarse_mesh>(), number, {}, {}, with_adhesion, "",
            k_ours,
            "Accept a mesh whose edges are longer than 20 h0, on which the rim of a contact catches: "
            "contacts stay too small."},
        Key{"contact", "omega_reading", choose<&S::contact, &Contact::omega_reading>(k_readings),
            number, {}, {}, with_adhesion, "", "README, 'Readings of omega'",
            "How omega becomes a work of adhesion W and an equilibrium overlap."},
        Key{"contact", "repulsion_k", reach<&S::contact, &Contact::repulsion_k_kPa_per_um>(),
            stiffness_per_area, positive, required, without_adhesion, "2.8 kPa/um",
            "omega / 2 h0^2 of the paper's values", "Pressure per overlap."},
        Key{"contact.adhesion", "omega", reach<&S::contact, &Contact::omega_nN_per_um>(), tension,
            positive, one_adhesion, without_W, "0.0625 ... 1 nN/um", k_table_2,
            "Adhesive tension."},
        Key{"contact.adhesion", "gamma_over_omega", reach<&Draft::gamma_over_omega>(), number,
            positive, adhesion_input, {}, "1/2 ... 8", k_table_1,
            "Sets omega = gamma / this; needs [cortex.tension]."},
        Key{"contact.adhesion", "W", reach<&S::contact, &Contact::W_nN_per_um>(), tension, positive,
            one_adhesion, with_W, "0.25 ... 1 nN/um", "", "Work of adhesion itself."},
        Key{"contact.adhesion", "equilibrium_overlap", reach<&Draft::equilibrium_overlap>(), number,
            one_or_two, {}, with_W, "1, 2", "",
            "Overlap at rest over h0: 2 when the real surfaces touch, 1 when a gap of h0 remains."},
        Key{"contact.friction", "normal",
            reach<&S::contact, &Contact::friction_normal_kPa_s_per_um>(), friction_per_area,
            not_negative, required, {}, "0.05 kPa s/um", k_table_2,
            "Against coming closer or apart."},
        Key{"contact.friction", "tangential",
            reach<&S::contact, &Contact::friction_tangential_kPa_s_per_um>(), friction_per_area,
            not_negative, required, {}, "0.05 kPa s/um", k_table_2, "Against sliding."},
        Key{"load.body_force", "force", reach<&S::body_force, &BodyForce::force_nN>(), force, {},
            required, {}, "1 nN", k_ours, "Components [x, y, z] for each cell."},
        Key{"load.body_force", "opposed", reach<&S::body_force, &BodyForce::opposed>(), number, {},
            {}, {}, "", k_ours,
            "Two cells only: the first gets the force, the second its opposite."},

        Key{"method", "name", reach<&S::method, &Method::name>(), number, {}, {}, {}, "",
            "engine/README.md, methods", "A row of the table of methods."},
        Key{"method", "dt", reach<&S::method, &Method::dt_s>(), time, positive,
            computed("eta t / (60 sqrt(3) gamma), else 1 ms; at most dt_max"), {}, "3.85 ms",
            k_table_2, "The step of `forward_euler`; the first step of an adaptive method."},
        Key{"method", "dt_max", reach<&S::method, &Method::dt_max_s>(), time, positive, {}, {},
            "0.1 ... 1 s", k_ours,
            "Longest adaptive step. Of `equilibrium` 1e6 s, so that only `every` of the stage bounds "
            "it."},
        Key{"method", "dt_min", reach<&S::method, &Method::dt_min_s>(), time, positive, {}, {},
            "1 us", k_ours, "A step that has to be shorter ends the run."},
        Key{"method", "tolerance", reach<&S::method, &Method::tolerance_um>(), length, not_negative,
            {}, {}, "6 nm = 0.02 h0", k_ours,
            "Local error of a step; 0 asks for fixed steps of dt."},
        Key{"method", "displacement_bound", reach<&S::method, &Method::displacement_bound_h0>(),
            number, positive, {}, with_contact, "0.3 ... 1", k_ours,
            "Largest displacement of a node in one adaptive step, over h0."},
        Key{"method", "linear_tolerance", reach<&S::method, &Method::linear_tolerance>(), number,
            fraction, {}, {}, "1e-3", k_ours,
            "Relative residual at which the linear solver stops."},
        Key{"method", "stable_step", choose<&S::method, &Method::stable_step>(k_stable_steps),
            number, {}, {}, with_forward_euler, "", k_ours,
            "What is done with the largest stable step, which is estimated five times per second: "
            "a larger dt ends the run; steps are 0.8 of it, at most dt_max, whatever dt is; "
            "nothing, to see what happens."},

        Key{"stage", "kind", choose<&S::stages, &Stage::kind>(k_stages), number, {}, required, {},
            "", "Cuvelier et al. 2021, Appendix E",
            "Pack beads; compress by a wall; keep the wall; take it away; let the cells come to "
            "rest; put a hull around them and press a bead into them (only as the last one)."},
        Key{"stage", "until", choose<&S::stages, &Stage::until>(k_untils), number, {}, {}, can_rest,
            "", k_ours,
            "`rest` needs small velocities and steady measures, `stationary` steady measures "
            "only. `rest` of an indentation: for 2 s the probe is slower than 5e-4 um/s, and its "
            "force and the sum of all forces are balanced to a thousandth."},
        Key{"stage", "duration", reach<&S::stages, &Stage::duration_s>(), time, positive, required,
            for_a_duration, "compact 5 s, hold 2 s, release 1 s", k_ours, "Model time."},
        Key{"stage", "cap", reach<&S::stages, &Stage::cap_s>(), time, positive, {}, until_quiet,
            "120 s", k_ours,
            "A run that has not come to rest by then ends without having converged."},
        Key{"stage", "every", reach<&S::stages, &Stage::every_s>(), time, not_negative, {},
            in_model_time, "0.1 ... 1 s", "",
            "Model time between outputs; 0: only at the end of the stage."},
        Key{"stage", "nodes", reach<&S::stages, &Stage::nodes>(), number, mesh_size, {}, {},
            "162 in stages before the last", k_ours,
            "Finest mesh that this stage is computed on, where cells.nodes is a finer one; where "
            "the next stage has a finer one the cells are carried over to it. Frames show all "
            "stages on the mesh of cells.nodes."},
        Key{"stage", "steps", reach<&S::stages, &Stage::steps>(), number, at_least_one, {},
            in_anneal, "20000", k_ours, "Steps of the beads."},
        Key{"stage", "packing_fraction", reach<&S::stages, &Stage::packing_fraction>(), number,
            packing, {}, in_anneal, "0.60", k_ours,
            "Volume of the beads over that of their container."},
        Key{"stage", "frames", reach<&S::stages, &Stage::frames>(), number, not_negative, {},
            in_anneal, "60", "", "Outputs during the steps."},
        Key{"stage", "volume_fraction", reach<&S::stages, &Stage::volume_fraction>(), number,
            fraction, {}, in_compact, "0.97", k_ours,
            "The wall stops when the cells fill this part of it."},
        Key{"stage", "contact_rate", reach<&S::stages, &Stage::contact_rate_per_s>(), rate,
            not_negative, {}, in_compact, "0.005 1/s", k_ours,
            "The wall stops when the contact fraction rises more slowly."},
        Key{"stage", "wall_stiffness", reach<&S::stages, &Stage::wall_stiffness>(), number,
            positive, {}, with_wall, "10", k_ours,
            "Of the wall, over that of a contact; of an indentation, that of hull and probe."},
        Key{"stage", "force", reach<&S::stages, &Stage::force_nN>(), force, positive, {},
            in_indent, "15 nN", k_appendix_g, "With which the probe is pressed into the cells."},
        Key{"stage", "probe_radius", reach<&S::stages, &Stage::probe_radius_um>(), length,
            positive, {}, in_indent, "27 um: three times a cell's", k_appendix_g,
            "Radius of the probe, a stiff bead."},
        Key{"stage", "probe_law", choose<&S::stages, &Stage::probe_law>(k_probe_laws), number, {},
            {}, in_indent, "", k_ours,
            "`linear`: pressure in proportion to the overlap of each node, as of the hull. `hertz`: "
            "on each cell F = 4/3 E* sqrt(R_eff) d^1.5, spread over the nodes that it touches as "
            "they overlap."},
        Key{"stage", "probe_modulus", reach<&S::stages, &Stage::probe_modulus_kPa>(), stiffness,
            positive, required, with_hertz, "20 kPa", k_ours, "E* of Hertz's law."},
        Key{"stage", "direction", reach<&S::stages, &Stage::direction>(), number, {}, {},
            in_indent, "[0, 0, -1]", k_ours,
            "In which the probe is pushed, of any length but zero; its line goes through the "
            "centre of the cells."},
        Key{"stage", "clearance", reach<&S::stages, &Stage::clearance_um>(), length, {}, {},
            in_indent, "0 um", k_ours,
            "Way of the probe until it touches the first node; not negative."},
        Key{"stage", "probe_drag", reach<&S::stages, &Stage::probe_drag>(), number, positive, {},
            in_indent, "1", k_ours,
            "Friction of the probe, over that of Stokes in the medium, 6 pi eta_f R."},
        Key{"stage", "hull_gap", reach<&S::stages, &Stage::hull_gap_um>(), length, {},
            computed("contact.h0"), in_indent, "h0", k_ours,
            "Distance of the hull from the outermost nodes; not negative."},
        Key{"stage", "opening", reach<&S::stages, &Stage::opening>(), number, not_negative, {},
            in_indent, "1.2", k_ours,
            "Radius of the hull's opening at the probe, over the probe's."},

        Key{"measures", "fields", reach<&S::measures, &Measures::fields>(), number, {}, {}, {}, "",
            "", "Rows of the table of fields. Those that pictures show are added."},
        Key{"measures", "touching_area", reach<&S::measures, &Measures::touching_area_um2>(), area,
            not_negative, {}, {}, "0.01 ... 1 um^2", k_ours,
            "Two cells touch above this contact area."},
        Key{"measures", "time_error", reach<&S::measures, &Measures::time_error>(), number, {}, {},
            {}, "", k_ours,
            "Run once more with steps half as long (about twice the time), and say how wrong the "
            "measures are by the time steps; without it that error is not known."},
        Key{"measures", "mesh_error", reach<&S::measures, &Measures::mesh_error>(), number, {}, {},
            {}, "", k_ours,
            "Run once more on the next coarser mesh, and on the one below it (about a quarter of the "
            "time), and say how wrong the measures are by the mesh."},
        Key{"picture", "name", reach<&S::pictures, &Picture::name>(), number, {}, {}, {}, "", "",
            "Part of file names; each picture has its own."},
        Key{"picture", "field", reach<&S::pictures, &Picture::field>(), number, {}, {}, {}, "", "",
            "Field on the cells; empty: plain cells."},
        Key{"picture", "size", reach<&S::pictures, &Picture::size_px>(), number, pixels, {}, {},
            "[1280, 720]", "", "Width and height, pixels."},
        Key{"picture", "range", reach<&S::pictures, &Picture::range>(), number, {}, {}, {}, "", "",
            "Of the colours: one for the whole run, one for each frame, or given.", k_ranges},
        Key{"picture", "given_range", reach<&S::pictures, &Picture::given_range>(), number, {},
            required, with_given_range, "", "",
            "Lowest and highest value, in the unit of the legend."},
        Key{"picture", "cutaway", reach<&S::pictures, &Picture::cutaway>(), number, {}, {}, {}, "",
            "", "Leave out whole cells on the near side."},
        Key{"picture", "network", reach<&S::pictures, &Picture::network>(), number, {}, {}, {}, "",
            "", "Draw the network of contact forces; needs [contact]."},
        Key{"picture", "stress_axes", reach<&S::pictures, &Picture::stress_axes>(), number, {}, {},
            {}, "", "", "Draw the principal axes of each cell's stress; needs [contact]."},
        Key{"picture", "exploded", reach<&S::pictures, &Picture::exploded>(), number, not_negative,
            {}, {}, "0.5", "",
            "Cells are drawn farther from the aggregate's middle by this share of their distance."},
        Key{"picture", "azimuth", reach<&S::pictures, &Picture::azimuth_deg>(), view_angle, {}, {},
            {}, "", "", "Of the camera, about the vertical axis."},
        Key{"picture", "elevation", reach<&S::pictures, &Picture::elevation_deg>(), view_angle,
            elevation, {}, {}, "", "", "Of the camera, above the horizon."},
        Key{"picture", "orbit", reach<&S::pictures, &Picture::orbit_deg>(), view_angle, {}, {}, {},
            "", "", "Turned over the whole movie."},
        Key{"picture", "fps", reach<&S::pictures, &Picture::fps>(), number, frame_rate, {}, {},
            "30", "", "Frames of the movie in a second."},
        Key{"picture", "smooth", reach<&S::pictures, &Picture::smooth>(), number, {}, {}, {}, "",
            "", "Edges without steps: four drawn pixels for each one. Without it pictures take less time."},
        Key{"picture", "plot", reach<&S::pictures, &Picture::plot>(), number, {}, {}, {},
            "sigma_h_core, volume_error", "",
            "Measure of the whole aggregate, drawn against time below the picture."},
        Key{"picture", "shots", reach<&S::pictures, &Picture::shots>(), number, {}, {}, {},
            "[\"play to 2 s\", \"freeze 3 s, orbit 360 deg\", \"play to end\"]", "",
            "What the movie shows one after the other; empty: every frame once."},

        Key{"expect", "min", reach<&S::expect, &Expect::min>(), number, {}, {}, {}, "", "",
            "Lowest value that is accepted."},
        Key{"expect", "max", reach<&S::expect, &Expect::max>(), number, {}, {}, {}, "", "",
            "Highest value that is accepted."},
        Key{"expect", "value", reach<&Draft::expected_values, &Draft::ExpectedValue::value>(),
            number, {}, expected_input, {}, "", "",
            "Sets min and max, together with one of the next two."},
        Key{"expect", "tolerance",
            reach<&Draft::expected_values, &Draft::ExpectedValue::tolerance>(), number, positive,
            expected_input, {}, "", "", "Absolute: value +- this."},
        Key{"expect", "relative", reach<&Draft::expected_values, &Draft::ExpectedValue::relative>(),
            number, positive, expected_input, {}, "", "", "Relative: value * (1 +- this)."},

        Key{"stability", "outcome", choose<&S::stability, &Stability::outcome>(k_outcomes), number,
            {}, required, {}, "", "",
            "The run comes to its end and meets [expect]; it stops, or is refused, with a reason; "
            "or one of the two."},
        Key{"stability", "names", reach<&S::stability, &Stability::names>(), number, {}, {}, {},
            "cell, edge", "", "Words that the reason for a stop must contain."},
        Key{"stability", "within", reach<&S::stability, &Stability::within_s>(), time,
            not_negative, {}, {}, "0.2 s", "",
            "Model time before which a run that stops must stop; 0: any."},
        Key{"stability", "largest_step", reach<&S::stability, &Stability::largest_step_h0>(),
            number, not_negative, {}, with_contact, "0.3", "",
            "Bound on the displacement of a node in any accepted step, over h0; 0: none."},
        Key{"stability", "forces_kept", reach<&S::stability, &Stability::forces_kept>(), number,
            not_negative, {}, {}, "1e-6", "",
            "Bound on the relative change of forces, stresses and surface tensions that shift and "
            "turn of [start] make, turned back; a scene that turns is turned by random rotations "
            "as well. 0: none."},
        Key{"stability", "pull_off", reach<&S::stability, &Stability::pull_off>(), number,
            not_negative, {}, with_contact, "0.02", "",
            "Bound on the relative difference between W and the work, per area that adheres, of "
            "pulling the two cells of the end apart as rigid bodies; 0: none."},
        Key{"variant", "name", reach<&S::variants, &Variant::name>(), number, {}, required, {}, "",
            "", "In the report."},
        Key{"variant", "set", reach<&S::variants, &Variant::set>(), number, {}, required, {}, "",
            "", "Keys as on the command line: [\"cells.nodes=642\"]."},
    };
    return rows;
}
// clang-format on

}  // namespace

std::span<const Table> all_tables() { return tables(); }
std::span<const Key> all_keys() { return keys(); }

const Key* find_key(std::string_view table, std::string_view name) {
    for (const Key& key : all_keys())
        if (key.table == table && key.name == name) return &key;
    return nullptr;
}

const Key* find_key(std::string_view path) {
    const auto dot = path.rfind('.');
    if (dot == std::string_view::npos) return nullptr;
    return find_key(path.substr(0, dot), path.substr(dot + 1));
}

std::string_view word_of(OmegaReading reading) {
    return k_readings.at(static_cast<std::size_t>(reading));
}

}  // namespace spheroscope::scene
