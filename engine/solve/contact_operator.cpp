#include "engine/solve/contact_operator.hpp"

#include <algorithm>

namespace spheroscope {
namespace {
std::size_t idx(int i) { return static_cast<std::size_t>(i); }
}  // namespace

void ContactOperator::clear() { n_groups_ = 0; }

void ContactOperator::build(const Model& model, const Contacts& contacts,
                            const std::optional<ContactFriction>& friction,
                            double stiffness_kPa_per_um, Workers& workers) {
    friction_ = friction;
    stiffness_kPa_per_um_ = stiffness_kPa_per_um;
    n_groups_ = contacts.groups.size();
    if (groups_.size() < n_groups_) groups_.resize(n_groups_);
    workers.loop(n_groups(), [&](int g) {
        build_group(model, contacts, contacts.groups[idx(g)], groups_[idx(g)]);
    });
}

void ContactOperator::build_group(const Model& model, const Contacts& contacts,
                                  const Contacts::Group& source, Group& group) const {
    group.cell_a = source.cell_a;
    group.cell_b = source.cell_b;
    group.nodes_a.clear();
    group.nodes_b.clear();
    group.elements.clear();
    const MeshTopology& mesh = *model.topology;
    thread_local std::vector<int> local_a, local_b;
    local_a.assign(idx(mesh.n_nodes()), -1);
    local_b.assign(idx(mesh.n_nodes()), -1);
    const auto local = [](int node, std::vector<int>& map, std::vector<int>& nodes) {
        int& position = map[idx(node)];
        if (position < 0) {
            position = static_cast<int>(nodes.size());
            nodes.push_back(node);
        }
        return static_cast<std::uint16_t>(position);
    };
    for (const ContactPair& pair : contacts.pairs_of(source)) {
        Element e;
        const auto& nodes_a = mesh.triangles[idx(pair.triangle_a)];
        const auto& nodes_b = mesh.triangles[idx(pair.triangle_b)];
        for (std::size_t i = 0; i < 3; ++i) {
            e.a[i] = local(nodes_a[i], local_a, group.nodes_a);
            e.b[i] = local(nodes_b[i], local_b, group.nodes_b);
        }
        e.graph = {pair.lambda, pair.mu};
        e.normal = pair.normal;
        e.tangential = friction_ ? pair.area_um2 * friction_->tangential_kPa_s_per_um : 0.0;
        e.normal_extra = friction_ ? pair.area_um2 * (friction_->normal_kPa_s_per_um -
                                                      friction_->tangential_kPa_s_per_um)
                                   : 0.0;
        e.stiffness = pair.area_um2 * stiffness_kPa_per_um_;
        group.elements.push_back(e);
    }
    group.u.resize(group.nodes_a.size() + group.nodes_b.size());
    group.y.resize(group.u.size());
}

void ContactOperator::product_of_group(int g, const Model& model, double dt_s,
                                       std::span<const Vec3> u) {
    Group& group = groups_[idx(g)];
    const std::span<const Vec3> u_a = model.cell_nodes(u, group.cell_a);
    const std::span<const Vec3> u_b = model.cell_nodes(u, group.cell_b);
    const std::size_t n_a = group.nodes_a.size();
    for (std::size_t i = 0; i < n_a; ++i) group.u[i] = u_a[idx(group.nodes_a[i])];
    for (std::size_t i = 0; i < group.nodes_b.size(); ++i)
        group.u[n_a + i] = u_b[idx(group.nodes_b[i])];
    std::fill(group.y.begin(), group.y.end(), Vec3::Zero());
    const bool has_normal_extra =
        friction_ && friction_->normal_kPa_s_per_um != friction_->tangential_kPa_s_per_um;
    for (const Element& e : group.elements) {
        const std::array<Vec3, 3> a{group.u[e.a[0]], group.u[e.a[1]], group.u[e.a[2]]};
        const std::array<Vec3, 3> b{group.u[n_a + e.b[0]], group.u[n_a + e.b[1]],
                                    group.u[n_a + e.b[2]]};
        std::array<Vec3, 3> y_a, y_b;
        e.graph.product(a, b, y_a, y_b);
        const auto& l = e.graph.lambda;
        const auto& m = e.graph.mu;
        // Stiffness: k S n n^T on the relative displacement at the polygon's centroid.
        const Vec3 relative =
            l[0] * a[0] + l[1] * a[1] + l[2] * a[2] - (m[0] * b[0] + m[1] * b[1] + m[2] * b[2]);
        const Vec3 spring = (dt_s * e.stiffness * e.normal.dot(relative)) * e.normal;
        for (std::size_t i = 0; i < 3; ++i) {
            group.y[e.a[i]] += e.tangential * y_a[i] + l[i] * spring;
            group.y[n_a + e.b[i]] += e.tangential * y_b[i] - m[i] * spring;
        }
        if (!has_normal_extra) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            group.y[e.a[i]] += (e.normal_extra * e.normal.dot(y_a[i])) * e.normal;
            group.y[n_a + e.b[i]] += (e.normal_extra * e.normal.dot(y_b[i])) * e.normal;
        }
    }
}

void ContactOperator::add_to_cell(int cell, const Contacts& contacts, std::span<Vec3> out) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Group& group = groups_[idx(side.group)];
        const std::vector<int>& nodes = side.is_a ? group.nodes_a : group.nodes_b;
        const std::size_t first = side.is_a ? 0 : group.nodes_a.size();
        for (std::size_t i = 0; i < nodes.size(); ++i) out[idx(nodes[i])] += group.y[first + i];
    }
}

void ContactOperator::add_diagonal(int cell, const Contacts& contacts, double dt_s,
                                   std::span<Mat3> blocks) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Group& group = groups_[idx(side.group)];
        const std::vector<int>& nodes = side.is_a ? group.nodes_a : group.nodes_b;
        for (const Element& e : group.elements) {
            const auto& local = side.is_a ? e.a : e.b;
            const auto& weight = side.is_a ? e.graph.lambda : e.graph.mu;
            for (std::size_t i = 0; i < 3; ++i) {
                const double graph = PairGraph::diagonal(weight[i]);
                const double along_n =
                    e.normal_extra * graph + dt_s * e.stiffness * weight[i] * weight[i];
                blocks[idx(nodes[local[i]])] += (e.tangential * graph) * Mat3::Identity() +
                                                along_n * e.normal * e.normal.transpose();
            }
        }
    }
}

}  // namespace spheroscope
