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
        for (std::size_t i = 0; i < 2; ++i) {
            e.lambda[i] = static_cast<float>(pair.lambda[i]);
            e.mu[i] = static_cast<float>(pair.mu[i]);
        }
        for (std::size_t i = 0; i < 3; ++i)
            e.normal[i] = static_cast<float>(pair.normal[static_cast<Eigen::Index>(i)]);
        const double area_um2 = pair.area_um2;
        e.tangential = 0.0F;
        e.normal_extra = 0.0F;
        if (friction_) {
            const double tangential = friction_->tangential_kPa_s_per_um;
            const double normal = friction_->normal_kPa_s_per_um;
            e.tangential = static_cast<float>(area_um2 * tangential / 6.0);
            e.normal_extra = static_cast<float>(area_um2 * (normal - tangential) / 6.0);
        }
        e.stiffness = static_cast<float>(area_um2 * stiffness_kPa_per_um_);
        group.elements.push_back(e);
    }
    const std::size_t n_a = group.nodes_a.size();
    for (Element& e : group.elements)
        for (std::uint16_t& k : e.b) k = static_cast<std::uint16_t>(k + n_a);
    const std::size_t n = n_a + group.nodes_b.size();
    group.in_double.u.resize(n);
    group.in_double.y.resize(n);
    group.in_single.u.resize(n);
    group.in_single.y.resize(n);
}

template <class Vector> void ContactOperator::product_of_group(int g, const Model& model,
                                                               double dt_s,
                                                               std::span<const Vector> u_all) {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    Group& group = groups_[idx(g)];
    Local<Vector>& local = group.local<Vector>();
    const std::span<const Vector> u_a = model.cell_nodes(u_all, group.cell_a);
    const std::span<const Vector> u_b = model.cell_nodes(u_all, group.cell_b);
    const std::size_t n_a = group.nodes_a.size();
    for (std::size_t i = 0; i < n_a; ++i) local.u[i] = u_a[idx(group.nodes_a[i])];
    for (std::size_t i = 0; i < group.nodes_b.size(); ++i)
        local.u[n_a + i] = u_b[idx(group.nodes_b[i])];
    std::fill(local.y.begin(), local.y.end(), VectorTraits<Vector>::zero());
    const bool has_normal_extra =
        friction_ && friction_->normal_kPa_s_per_um != friction_->tangential_kPa_s_per_um;
    const auto dt = static_cast<Scalar>(dt_s);
    const Vector* const u = local.u.data();
    Vector* const y = local.y.data();
    for (const Element& e : group.elements) {
        const Scalar l0 = e.lambda[0], l1 = e.lambda[1], l2 = Scalar{1} - l0 - l1;
        const Scalar m0 = e.mu[0], m1 = e.mu[1], m2 = Scalar{1} - m0 - m1;
        const Vector a0 = u[e.a[0]], a1 = u[e.a[1]], a2 = u[e.a[2]];
        const Vector b0 = u[e.b[0]], b1 = u[e.b[1]], b2 = u[e.b[2]];
        const Vector n = VectorTraits<Vector>::from(e.normal);
        const Vector mean_a = l0 * a0 + l1 * a1 + l2 * a2;
        const Vector mean_b = m0 * b0 + m1 * b1 + m2 * b2;
        // Stiffness: k S n n^T on the relative displacement at the polygon's centroid.
        const Vector spring = (dt * Scalar{e.stiffness} * n.dot(mean_a - mean_b)) * n;
        // Friction (engine/friction/contact_friction.hpp), with the spring, which is shared among
        // the nodes by the same barycentric coordinates:
        //   y_i = f [(3 l_i + 1) u_i - mean_b] + l_i [spring - f sum_b],  f = S g_t / 6.
        const Scalar f = e.tangential;
        const Vector shared_a = spring - f * (b0 + b1 + b2);
        const Vector shared_b = VectorTraits<Vector>::zero() - spring - f * (a0 + a1 + a2);
        const Vector back_a = f * mean_b, back_b = f * mean_a;
        const auto node = [f](Scalar w, const Vector& own, const Vector& shared,
                              const Vector& back) -> Vector {
            return (f * (Scalar{3} * w + Scalar{1})) * own + w * shared - back;
        };
        y[e.a[0]] += node(l0, a0, shared_a, back_a);
        y[e.a[1]] += node(l1, a1, shared_a, back_a);
        y[e.a[2]] += node(l2, a2, shared_a, back_a);
        y[e.b[0]] += node(m0, b0, shared_b, back_b);
        y[e.b[1]] += node(m1, b1, shared_b, back_b);
        y[e.b[2]] += node(m2, b2, shared_b, back_b);
        if (!has_normal_extra) continue;
        // The same graph once more, along n alone.
        const Scalar extra = e.normal_extra;
        const auto along = [&](Scalar w, const Vector& own, const Vector& sum,
                               const Vector& mean) -> Vector {
            const Vector graph = (Scalar{3} * w + Scalar{1}) * own - w * sum - mean;
            return (extra * n.dot(graph)) * n;
        };
        const Vector sum_a = a0 + a1 + a2, sum_b = b0 + b1 + b2;
        y[e.a[0]] += along(l0, a0, sum_b, mean_b);
        y[e.a[1]] += along(l1, a1, sum_b, mean_b);
        y[e.a[2]] += along(l2, a2, sum_b, mean_b);
        y[e.b[0]] += along(m0, b0, sum_a, mean_a);
        y[e.b[1]] += along(m1, b1, sum_a, mean_a);
        y[e.b[2]] += along(m2, b2, sum_a, mean_a);
    }
}

template <class Vector>
void ContactOperator::add_to_cell(int cell, const Contacts& contacts, std::span<Vector> out) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Group& group = groups_[idx(side.group)];
        const std::vector<int>& nodes = side.is_a ? group.nodes_a : group.nodes_b;
        const Vector* const y =
            group.local<Vector>().y.data() + (side.is_a ? 0 : group.nodes_a.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) out[idx(nodes[i])] += y[i];
    }
}

template void ContactOperator::product_of_group(int, const Model&, double, std::span<const Vec3>);
template void ContactOperator::product_of_group(int, const Model&, double, std::span<const Lanes>);
template void ContactOperator::add_to_cell(int, const Contacts&, std::span<Vec3>) const;
template void ContactOperator::add_to_cell(int, const Contacts&, std::span<Lanes>) const;

void ContactOperator::add_diagonal(int cell, const Contacts& contacts, double dt_s,
                                   std::span<Mat3> blocks) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Group& group = groups_[idx(side.group)];
        const std::vector<int>& nodes = side.is_a ? group.nodes_a : group.nodes_b;
        const std::size_t first = side.is_a ? 0 : group.nodes_a.size();
        for (const Element& e : group.elements) {
            const auto& local = side.is_a ? e.a : e.b;
            const auto& stored = side.is_a ? e.lambda : e.mu;
            const double w0 = double{stored[0]}, w1 = double{stored[1]};
            const Vec3 n = VectorTraits<Vec3>::from(e.normal);
            const Mat3 along = n * n.transpose();
            const std::array weight{w0, w1, 1.0 - w0 - w1};
            for (std::size_t i = 0; i < 3; ++i) {
                const double graph = 3.0 * weight[i] + 1.0;
                const double along_n = double{e.normal_extra} * graph +
                                       dt_s * double{e.stiffness} * weight[i] * weight[i];
                blocks[idx(nodes[local[i] - first])] +=
                    (double{e.tangential} * graph) * Mat3::Identity() + along_n * along;
            }
        }
    }
}

}  // namespace spheroscope
