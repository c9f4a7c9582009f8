#include "engine/solve/contact_operator.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <bit>

namespace spheroscope {
namespace {

/// Sums of one pair of nodes over the pairs of triangles that connect it, in two registers: of a
/// weight w and of weighted squares n n^T.
struct Sums {
    Lanes::Register a{};  // xx, yy, zz, xy
    Lanes::Register b{};  // xz, yz, w, nothing
    [[nodiscard]] float weight() const { return b[2]; }
    [[nodiscard]] std::array<float, 6> square() const {
        return {a[0], a[1], a[2], a[3], b[0], b[1]};
    }
};

/// n n^T laid out like this.
Sums square_of(const Vec3& n) {
    const auto x = static_cast<float>(n.x()), y = static_cast<float>(n.y()),
               z = static_cast<float>(n.z());
    Sums nn;
    nn.a = Lanes::Register{x * x, y * y, z * z, x * y};
    nn.b = Lanes::Register{x * z, y * z, 0.0F, 0.0F};
    return nn;
}

/// Memory of a member that builds one group after another.
struct Scratch {
    std::vector<int> local_a, local_b;                  // node of the cell -> local array, or -1
    std::vector<std::array<std::uint16_t, 6>> corners;  // [pairs of triangles], B's from 0
    std::vector<std::uint64_t> marks;       // [nodes_a] rows of bits, one for each of B's
    std::vector<int> entry;                 // [nodes_a x nodes_b]: pair of nodes
    std::vector<Sums> friction, stiffness;  // [pairs of nodes]
};

std::uint16_t local_index(int node, std::vector<int>& map, std::vector<int>& nodes) {
    int& position = map[idx(node)];
    if (position < 0) {
        position = static_cast<int>(nodes.size());
        nodes.push_back(node);
    }
    return static_cast<std::uint16_t>(position);
}

}  // namespace

void ContactOperator::build(const Model& model, const Contacts& contacts,
                            const std::optional<ContactFriction>& friction,
                            double stiffness_kPa_s_per_um, Workers& workers) {
    friction_ = friction;
    stiffness_kPa_s_per_um_ = stiffness_kPa_s_per_um;
    n_groups_ = contacts.groups.size();
    if (groups_.size() < n_groups_) groups_.resize(n_groups_);
    arenas_.resize(idx(workers.size()));
    workers.region([&](Workers::Member& member) {
        std::vector<NodePair>& arena = arenas_[idx(member.index())];
        arena.clear();
        const Workers::Member::Range share = member.share(n_groups());
        for (int g = share.begin; g < share.end; ++g) {
            Group& group = groups_[idx(g)];
            group.arena = idx(member.index());
            group.first = arena.size();
            build_group(model, contacts.groups[idx(g)], group, arena);
        }
    });
}

void ContactOperator::build_group(const Model& model, const Contacts::Group& source, Group& group,
                                  std::vector<NodePair>& arena) const {
    thread_local Scratch scratch;
    const MeshTopology& mesh = *model.topology;
    const std::span<const ContactPair> pairs = Contacts::pairs_of(source);

    // Which nodes take part.
    group.cell_a = source.cell_a;
    group.cell_b = source.cell_b;
    group.nodes_a.clear();
    group.nodes_b.clear();
    scratch.local_a.assign(idx(mesh.n_nodes()), -1);
    scratch.local_b.assign(idx(mesh.n_nodes()), -1);
    scratch.corners.resize(pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p)
        for (std::size_t i = 0; i < 3; ++i) {
            scratch.corners[p][i] = local_index(mesh.triangles[idx(pairs[p].triangle_a)][i],
                                                scratch.local_a, group.nodes_a);
            scratch.corners[p][3 + i] = local_index(mesh.triangles[idx(pairs[p].triangle_b)][i],
                                                    scratch.local_b, group.nodes_b);
        }
    const std::size_t n_a = group.nodes_a.size(), n_b = group.nodes_b.size();

    // Which of them are connected: a bit for each, then row by row the numbers of the pairs. Only
    // what has a number is read from `entry`.
    const std::size_t n_words = n_b / 64 + 1;
    scratch.marks.assign(n_a * n_words, 0);
    for (const auto& c : scratch.corners)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 3; k < 6; ++k)
                scratch.marks[c[i] * n_words + c[k] / 64] |= std::uint64_t{1} << (c[k] % 64);
    if (scratch.entry.size() < n_a * n_b) scratch.entry.resize(n_a * n_b);
    group.row_begin.resize(n_a + 1);
    for (std::size_t a = 0; a < n_a; ++a) {
        group.row_begin[a] = static_cast<int>(arena.size() - group.first);
        for (std::size_t word = 0; word < n_words; ++word)
            for (std::uint64_t bits = scratch.marks[a * n_words + word]; bits != 0;
                 bits &= bits - 1) {
                const std::size_t b = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
                scratch.entry[a * n_b + b] = static_cast<int>(arena.size() - group.first);
                arena.push_back({{}, 0.0F, static_cast<std::uint16_t>(n_a + b)});
            }
    }
    const std::size_t n_entries = arena.size() - group.first;
    group.row_begin[n_a] = static_cast<int>(n_entries);

    const double tangential = friction_ ? friction_->tangential_kPa_s_per_um : 0.0;
    const double rest = friction_ ? friction_->normal_kPa_s_per_um - tangential : 0.0;
    const bool is_stiff = stiffness_kPa_s_per_um_ > 0.0;
    scratch.friction.assign(n_entries, Sums{});
    scratch.stiffness.assign(is_stiff ? n_entries : 0, Sums{});
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const ContactPair& pair = pairs[p];
        const Sums nn = square_of(pair.normal);
        const auto area = static_cast<float>(pair.area_um2);
        for (std::size_t i = 0; i < 3; ++i) {
            const int* const row = scratch.entry.data() + scratch.corners[p][i] * n_b;
            const auto lambda = static_cast<float>(pair.lambda[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto mu = static_cast<float>(pair.mu[k]);
                const std::size_t entry = idx(row[scratch.corners[p][3 + k]]);
                Sums& friction = scratch.friction[entry];
                const float weight = area * (lambda + mu) / 6.0F;
                friction.b += Lanes::Register{0.0F, 0.0F, weight, 0.0F};
                if (rest != 0.0) {
                    friction.a += weight * nn.a;
                    friction.b += weight * nn.b;
                }
                if (is_stiff) {
                    Sums& stiffness = scratch.stiffness[entry];
                    const float product = area * lambda * mu;
                    stiffness.a += product * nn.a;
                    stiffness.b += product * nn.b;
                }
            }
        }
    }

    group.normal.resize(rest != 0.0 ? n_entries : 0);
    for (std::size_t e = 0; e < n_entries; ++e) {
        arena[group.first + e].friction =
            static_cast<float>(tangential) * scratch.friction[e].weight();
        if (rest != 0.0) {
            group.normal[e].entry = scratch.friction[e].square();
            for (float& entry : group.normal[e].entry) entry *= static_cast<float>(rest);
        }
        if (!is_stiff) continue;
        std::array<float, 6>& combined = arena[group.first + e].combined.entry;
        combined = scratch.stiffness[e].square();
        for (std::size_t m = 0; m < 6; ++m) {
            combined[m] *= static_cast<float>(stiffness_kPa_s_per_um_);
            if (rest != 0.0) combined[m] += group.normal[e].entry[m];
            if (m < 3) combined[m] += arena[group.first + e].friction;
        }
    }
    const std::size_t n = n_a + n_b;
    group.in_double.u.resize(n);
    group.in_double.y.resize(n);
    group.in_single.u.resize(n);
    group.in_single.y.resize(n);
}

template <class Vector> void ContactOperator::product_of_group(int g, const Model& model, Part part,
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
    const Vector* const u = local.u.data();
    Vector* const y = local.y.data();
    const NodePair* const pairs = pairs_of(group);
    const auto for_each_pair = [&](const auto& force_of) {
        for (std::size_t a = 0; a < n_a; ++a) {
            const Vector at_a = u[a];
            Vector sum = VectorTraits<Vector>::zero();
            const auto end = static_cast<std::size_t>(group.row_begin[a + 1]);
            for (auto e = static_cast<std::size_t>(group.row_begin[a]); e < end; ++e) {
                const std::uint16_t b = pairs[e].b;
                const Vector force = force_of(e, Vector(at_a - u[b]));
                sum += force;
                y[b] -= force;
            }
            y[a] += sum;
        }
    };
    if (part == Part::friction_and_stiffness && stiffness_kPa_s_per_um_ > 0.0) {
        for_each_pair(
            [&](std::size_t e, const Vector& d) { return product(pairs[e].combined, d); });
        return;
    }
    for_each_pair([&](std::size_t e, const Vector& d) -> Vector {
        return static_cast<Scalar>(pairs[e].friction) * d;
    });
    if (!group.normal.empty())
        for_each_pair([&](std::size_t e, const Vector& d) { return product(group.normal[e], d); });
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

template void ContactOperator::product_of_group(int, const Model&, Part, std::span<const Vec3>);
template void ContactOperator::product_of_group(int, const Model&, Part, std::span<const Lanes>);
template void ContactOperator::add_to_cell(int, const Contacts&, std::span<Vec3>) const;
template void ContactOperator::add_to_cell(int, const Contacts&, std::span<Lanes>) const;

Mat3 ContactOperator::sum_of(int g) const {
    const Group& group = groups_[idx(g)];
    Mat3 sum = Mat3::Zero();
    for (int e = 0; e < group.row_begin.back(); ++e) sum += pairs_of(group)[idx(e)].combined.mat3();
    return sum;
}

void ContactOperator::add_diagonal(int cell, const Contacts& contacts,
                                   std::span<Mat3> blocks) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Group& group = groups_[idx(side.group)];
        const std::size_t n_a = group.nodes_a.size();
        for (std::size_t a = 0; a < n_a; ++a)
            for (int e = group.row_begin[a]; e < group.row_begin[a + 1]; ++e) {
                const NodePair& pair = pairs_of(group)[idx(e)];
                Mat3& block =
                    blocks[idx(side.is_a ? group.nodes_a[a] : group.nodes_b[pair.b - n_a])];
                if (stiffness_kPa_s_per_um_ > 0.0) {
                    block += pair.combined.mat3();
                    continue;
                }
                block.diagonal().array() += static_cast<double>(pair.friction);
                if (!group.normal.empty()) block += group.normal[idx(e)].mat3();
            }
    }
}

void ContactOperator::add_own_stiffness(int cell, const Model& model, const Contacts& contacts,
                                        double stiffness_kPa_s_per_um, CellMatrix& matrix) {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Contacts::Group& group = contacts.groups[idx(side.group)];
        for (const ContactPair& pair : Contacts::pairs_of(group))
            matrix.add_between(
                model.topology->triangles[idx(side.is_a ? pair.triangle_a : pair.triangle_b)],
                side.is_a ? pair.lambda : pair.mu, pair.normal,
                stiffness_kPa_s_per_um * pair.area_um2);
    }
}

}  // namespace spheroscope
