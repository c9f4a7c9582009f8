// Every force on one node, term by term, and the velocity with which friction balances them.
#include "engine/base/counted.hpp"
#include "engine/base/index.hpp"
#include "engine/forces/contact_variational.hpp"
#include "engine/friction/cortex_viscosity.hpp"
#include "engine/inspect/inspect_contact.hpp"
#include "engine/solve/friction_matrix.hpp"

namespace spheroscope::inspect {
namespace {

/// Adds the contact forces of a cell to rows, one for each neighbour.
void add_contacts(const FrameSystem& frame, const Configuration& at, int cell, int node,
                  std::vector<NodeForce>& rows) {
    const MeshTopology& mesh = *at.model.topology;
    for (const Contacts::Side& side : at.contacts.sides_of(cell)) {
        const Contacts::Group& group = at.contacts.groups[idx(side.group)];
        Vec3 sum = Vec3::Zero();
        for (const ContactPair& pair : group.pairs)
            for (std::size_t i = 0; i < 3; ++i) {
                const int triangle = side.is_a ? pair.triangle_a : pair.triangle_b;
                if (mesh.triangles[idx(triangle)][i] != node) continue;
                sum += side.is_a ? Vec3(pair.force_a_nN[i] * pair.normal)
                                 : Vec3(-pair.force_b_nN[i] * pair.normal);
            }
        for (const ContactFilm& film : Contacts::films_of(group, side.is_a)) {
            const auto force = film_forces_nN(at, cell, film);
            for (std::size_t i = 0; i < 3; ++i)
                if (mesh.triangles[idx(film.triangle)][i] == node) sum += force[i];
        }
        const int other = frame.cell_of_run(side.is_a ? group.cell_b : group.cell_a);
        if (sum != Vec3::Zero())
            rows.push_back({"contact with cell " + std::to_string(other), sum});
    }
}

/// Friction with the other cells, eqns (17), (18), from its definition.
Vec3 contact_friction_nN(const Configuration& at, const ContactFriction& friction,
                         std::span<const Vec3> v, int cell, int node) {
    const MeshTopology& mesh = *at.model.topology;
    Vec3 sum = Vec3::Zero();
    for (const Contacts::Side& side : at.contacts.sides_of(cell)) {
        const Contacts::Group& group = at.contacts.groups[idx(side.group)];
        const auto own = at.model.cell_nodes(v, cell);
        const auto others = at.model.cell_nodes(v, side.is_a ? group.cell_b : group.cell_a);
        for (const ContactPair& pair : group.pairs) {
            const auto& mine = mesh.triangles[idx(side.is_a ? pair.triangle_a : pair.triangle_b)];
            const auto& its = mesh.triangles[idx(side.is_a ? pair.triangle_b : pair.triangle_a)];
            const auto& own_weight = side.is_a ? pair.lambda : pair.mu;
            const auto& other_weight = side.is_a ? pair.mu : pair.lambda;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3 && mine[i] == node; ++k) {
                    const Vec3 slip = own[idx(node)] - others[idx(its[k])];
                    const Vec3 along = slip.dot(pair.normal) * pair.normal;
                    sum -= (own_weight[i] + other_weight[k]) / 6.0 * pair.area_um2 *
                           (friction.normal_kPa_s_per_um * along +
                            friction.tangential_kPa_s_per_um * (slip - along));
                }
        }
    }
    return sum;
}

void check_is_there(const Model& model, int cell, int node) {
    if (cell < 0 || cell >= model.n_cells())
        throw Error("there is no cell " + std::to_string(cell),
                    "the run has " + counted(model.n_cells(), "cell") + ", counted from 0");
    if (node < 0 || node >= model.n_nodes())
        throw Error("there is no node " + std::to_string(node),
                    "a cell has " + std::to_string(model.n_nodes()) + " nodes in this frame, " +
                        "counted from 0");
}

void add_terms(FrameSystem& frame, const Configuration& at, int cell, int node,
               std::vector<NodeForce>& rows) {
    const Model& model = frame.system().model();
    const SystemParts& parts = frame.system().parts();
    for (const auto& term : parts.terms) {
        if (term.get() == parts.wall && at.wall_radius_um <= 0.0) continue;
        if (term->name().starts_with("contact")) {
            add_contacts(frame, at, cell, node, rows);
            continue;
        }
        std::vector<Vec3> F(idx(model.n_nodes()), Vec3::Zero());
        term->add_force(at, cell, F);
        rows.push_back({std::string(term->name()), F[idx(node)]});
    }
}

/// v: velocities of all nodes, um/s.
void add_frictions(FrameSystem& frame, const Configuration& at, std::span<const Vec3> v, int cell,
                   int node, std::vector<NodeForce>& rows) {
    System& system = frame.system();
    const Model& model = system.model();
    const Frictions& frictions = system.parts().frictions;
    const std::size_t place = idx(cell) * idx(model.n_nodes()) + idx(node);
    rows.push_back(
        {"friction: medium", -v[place] * node_drags(model, frictions.eta_f_kPa_s)[place]});
    const std::span<const Vec3> of_cell = model.cell_nodes(v, cell);
    if (frictions.edge_nN_s_per_um > 0.0) {
        std::vector<Vec3> out(idx(model.n_nodes()), Vec3::Zero());
        add_cortex_friction(*model.topology, frictions.edge_nN_s_per_um, of_cell, out);
        rows.push_back({"friction: cortex", -out[idx(node)]});
    }
    if (const auto coefficient = system.volume_friction(); !coefficient.empty()) {
        const auto S =
            model.cell_nodes(std::span<const Vec3>(at.geometry.volume_gradient_um2), cell);
        double rate_um3_per_s = 0.0;
        for (std::size_t i = 0; i < S.size(); ++i) rate_um3_per_s += S[i].dot(of_cell[i]);
        rows.push_back({"volume controller, derivative part",
                        -coefficient[idx(cell)] * rate_um3_per_s * S[idx(node)]});
    }
    if (frictions.contact)
        rows.push_back(
            {"friction: contacts", contact_friction_nN(at, *frictions.contact, v, cell, node)});
}

}  // namespace

NodeForces forces_on_node(FrameSystem& frame, int cell, int node) {
    const Model& model = frame.system().model();
    check_is_there(model, cell, node);
    const Configuration at = frame.system().configuration();
    const std::vector<Vec3> v = solved_velocities_um_per_s(frame);
    const std::size_t place = idx(cell) * idx(model.n_nodes()) + idx(node);

    NodeForces result;
    result.cell = cell;
    result.node = node;
    result.x_um = at.x_um[place];
    result.v_um_per_s = v[place];
    add_terms(frame, at, cell, node, result.terms);
    add_frictions(frame, at, v, cell, node, result.frictions);
    for (const NodeForce& row : result.terms) {
        result.drive_nN += row.force_nN;
        result.scale_nN += row.force_nN.norm();
    }
    result.residual_nN = result.drive_nN;
    for (const NodeForce& row : result.frictions) {
        result.residual_nN += row.force_nN;
        result.scale_nN += row.force_nN.norm();
    }
    return result;
}

}  // namespace spheroscope::inspect
