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

std::uint16_t local_index(int node, std::vector<int>& map, std::vector<std::uint16_t>& nodes) {
    int& position = map[idx(node)];
    if (position < 0) {
        position = static_cast<int>(nodes.size());
        nodes.push_back(static_cast<std::uint16_t>(node));
    }
    return static_cast<std::uint16_t>(position);
}

}  // namespace

/// Memory of a member that builds one group after another.
struct ContactOperator::Scratch {
    std::vector<int> local_a, local_b;            // node of the cell -> place among those, or -1
    std::vector<std::uint16_t> nodes_a, nodes_b;  // that take part
    std::vector<std::array<std::uint16_t, 6>> corners;  // [pairs of triangles], B's from 0
    std::vector<std::uint64_t> marks;       // [nodes_a] rows of bits, one for each of B's
    std::vector<int> entry;                 // [nodes_a x nodes_b]: pair of nodes
    std::vector<Sums> friction, stiffness;  // [pairs of nodes]
};

void ContactOperator::build(const Model& model, const Contacts& contacts,
                            const std::optional<ContactFriction>& friction,
                            double stiffness_kPa_s_per_um, Workers& workers) {
    friction_ = friction;
    stiffness_kPa_s_per_um_ = stiffness_kPa_s_per_um;
    n_groups_ = contacts.groups.size();
    groups_.resize(n_groups_);
    arenas_.resize(idx(workers.size()));
    workers.region([&](Workers::Member& member) {
        Arena& arena = arenas_[idx(member.index())];
        arena.pairs.clear();
        arena.normal.clear();
        arena.row_begin.clear();
        arena.nodes.clear();
        const Workers::Member::Range share = member.share(n_groups());
        for (int g = share.begin; g < share.end; ++g) {
            Group& group = groups_[idx(g)];
            group.arena = idx(member.index());
            build_group(model, contacts.groups[idx(g)], group, arena);
        }
    });
    lay_out_slots(contacts, model.n_cells());
}

void ContactOperator::lay_out_slots(const Contacts& contacts, int n_cells) {
    first_slot_.clear();
    slot_node_.clear();
    for (int cell = 0; cell < n_cells; ++cell) {
        first_slot_.push_back(slot_node_.size());
        for (const Contacts::Side& side : contacts.sides_of(cell)) {
            Group& group = groups_[idx(side.group)];
            (side.is_a ? group.slot_a : group.slot_b) = slot_node_.size();
            const auto nodes =
                arenas_[group.arena].nodes.begin() + static_cast<std::ptrdiff_t>(group.first_node);
            const auto first_of_b = nodes + static_cast<std::ptrdiff_t>(group.n_a);
            if (side.is_a)
                slot_node_.insert(slot_node_.end(), nodes, first_of_b);
            else
                slot_node_.insert(slot_node_.end(), first_of_b,
                                  first_of_b + static_cast<std::ptrdiff_t>(group.n_b));
        }
    }
    first_slot_.push_back(slot_node_.size());
    left_in_double_.resize(slot_node_.size());
    left_in_single_.resize(slot_node_.size());
}

ContactOperator::View ContactOperator::view(const Group& group) const {
    const Arena& arena = arenas_[group.arena];
    return {group.n_a,
            arena.pairs.data() + group.first_pair,
            arena.normal.empty() ? nullptr : arena.normal.data() + group.first_pair,
            arena.row_begin.data() + group.first_row,
            slot_node_.data() + group.slot_a,
            slot_node_.data() + group.slot_b};
}

void ContactOperator::build_group(const Model& model, const Contacts::Group& source, Group& group,
                                  Arena& arena) const {
    thread_local Scratch scratch;
    const std::span<const ContactPair> pairs = Contacts::pairs_of(source);
    group.cell_a = source.cell_a;
    group.cell_b = source.cell_b;
    group.first_pair = arena.pairs.size();
    group.first_row = arena.row_begin.size();
    group.first_node = arena.nodes.size();
    number_nodes(*model.topology, pairs, group, arena, scratch);
    connect_nodes(group, arena, scratch);
    add_up(pairs, group, arena, scratch);
    write_blocks(group, arena, scratch);
}

void ContactOperator::number_nodes(const MeshTopology& mesh, std::span<const ContactPair> pairs,
                                   Group& group, Arena& arena, Scratch& scratch) {
    scratch.nodes_a.clear();
    scratch.nodes_b.clear();
    scratch.local_a.assign(idx(mesh.n_nodes()), -1);
    scratch.local_b.assign(idx(mesh.n_nodes()), -1);
    scratch.corners.resize(pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p)
        for (std::size_t i = 0; i < 3; ++i) {
            scratch.corners[p][i] = local_index(mesh.triangles[idx(pairs[p].triangle_a)][i],
                                                scratch.local_a, scratch.nodes_a);
            scratch.corners[p][3 + i] = local_index(mesh.triangles[idx(pairs[p].triangle_b)][i],
                                                    scratch.local_b, scratch.nodes_b);
        }
    group.n_a = scratch.nodes_a.size();
    group.n_b = scratch.nodes_b.size();
    arena.nodes.insert(arena.nodes.end(), scratch.nodes_a.begin(), scratch.nodes_a.end());
    arena.nodes.insert(arena.nodes.end(), scratch.nodes_b.begin(), scratch.nodes_b.end());
}

void ContactOperator::connect_nodes(const Group& group, Arena& arena, Scratch& scratch) {
    // A bit for each pair of nodes, then row by row the numbers of the pairs. Only what has a
    // number is read from `entry`.
    const std::size_t n_a = group.n_a, n_b = group.n_b, n_words = n_b / 64 + 1;
    scratch.marks.assign(n_a * n_words, 0);
    for (const auto& c : scratch.corners)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 3; k < 6; ++k)
                scratch.marks[c[i] * n_words + c[k] / 64] |= std::uint64_t{1} << (c[k] % 64);
    if (scratch.entry.size() < n_a * n_b) scratch.entry.resize(n_a * n_b);
    const auto n_pairs_so_far = [&] {
        return static_cast<int>(arena.pairs.size() - group.first_pair);
    };
    for (std::size_t a = 0; a < n_a; ++a) {
        arena.row_begin.push_back(n_pairs_so_far());
        for (std::size_t word = 0; word < n_words; ++word)
            for (std::uint64_t bits = scratch.marks[a * n_words + word]; bits != 0;
                 bits &= bits - 1) {
                const std::size_t b = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
                scratch.entry[a * n_b + b] = n_pairs_so_far();
                arena.pairs.push_back({{}, 0.0F, static_cast<std::uint16_t>(n_a + b)});
            }
    }
    arena.row_begin.push_back(n_pairs_so_far());
}

void ContactOperator::add_up(std::span<const ContactPair> pairs, const Group& group,
                             const Arena& arena, Scratch& scratch) const {
    const std::size_t n_entries = arena.pairs.size() - group.first_pair;
    const bool has_normal = normal_rest() != 0.0, is_stiff = stiffness_kPa_s_per_um_ > 0.0;
    scratch.friction.assign(n_entries, Sums{});
    scratch.stiffness.assign(is_stiff ? n_entries : 0, Sums{});
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const ContactPair& pair = pairs[p];
        const Sums nn = square_of(pair.normal);
        const auto area = static_cast<float>(pair.area_um2);
        for (std::size_t i = 0; i < 3; ++i) {
            const int* const row = scratch.entry.data() + scratch.corners[p][i] * group.n_b;
            const auto lambda = static_cast<float>(pair.lambda[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto mu = static_cast<float>(pair.mu[k]);
                const std::size_t entry = idx(row[scratch.corners[p][3 + k]]);
                Sums& friction = scratch.friction[entry];
                const float weight = area * (lambda + mu) / 6.0F;
                friction.b += Lanes::Register{0.0F, 0.0F, weight, 0.0F};
                if (has_normal) {
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
}

void ContactOperator::write_blocks(const Group& group, Arena& arena, const Scratch& scratch) const {
    const auto tangential = static_cast<float>(tangential_friction());
    const auto rest = static_cast<float>(normal_rest());
    for (std::size_t e = 0; e < scratch.friction.size(); ++e) {
        NodePair& pair = arena.pairs[group.first_pair + e];
        pair.friction = tangential * scratch.friction[e].weight();
        SymmetricBlock3 normal{};
        if (rest != 0.0F) {
            normal.entry = scratch.friction[e].square();
            for (float& entry : normal.entry) entry *= rest;
            arena.normal.push_back(normal);
        }
        if (!(stiffness_kPa_s_per_um_ > 0.0)) continue;
        std::array<float, 6>& combined = pair.combined.entry;
        combined = scratch.stiffness[e].square();
        for (std::size_t m = 0; m < 6; ++m) {
            combined[m] *= static_cast<float>(stiffness_kPa_s_per_um_);
            if (rest != 0.0F) combined[m] += normal.entry[m];
            if (m < 3) combined[m] += pair.friction;
        }
    }
}

template <class Vector> void ContactOperator::product_of_group(int g, const Model& model, Part part,
                                                               std::span<const Vector> u_all) {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    thread_local std::vector<Vector> values, results;  // A's nodes, then B's
    const Group& group = groups_[idx(g)];
    const View at = view(group);
    const std::size_t n_a = group.n_a, n = group.n_a + group.n_b;
    if (values.size() < n) values.resize(n);
    results.assign(n, VectorTraits<Vector>::zero());
    const std::span<const Vector> u_a = model.cell_nodes(u_all, group.cell_a);
    const std::span<const Vector> u_b = model.cell_nodes(u_all, group.cell_b);
    Vector* const u = values.data();
    Vector* const y = results.data();
    for (std::size_t i = 0; i < n_a; ++i) u[i] = u_a[at.nodes_a[i]];
    for (std::size_t i = n_a; i < n; ++i) u[i] = u_b[at.nodes_b[i - n_a]];
    const auto for_each_pair = [&](const auto& force_of) {
        for (std::size_t a = 0; a < n_a; ++a) {
            const Vector at_a = u[a];
            Vector sum = VectorTraits<Vector>::zero();
            const auto end = idx(at.row_begin[a + 1]);
            for (auto e = idx(at.row_begin[a]); e < end; ++e) {
                const std::uint16_t b = at.pairs[e].b;
                const Vector force = force_of(e, Vector(at_a - u[b]));
                sum += force;
                y[b] -= force;
            }
            y[a] += sum;
        }
    };
    if (part == Part::friction_and_stiffness && stiffness_kPa_s_per_um_ > 0.0) {
        for_each_pair(
            [&](std::size_t e, const Vector& d) { return product(at.pairs[e].combined, d); });
    } else {
        for_each_pair([&](std::size_t e, const Vector& d) -> Vector {
            return static_cast<Scalar>(at.pairs[e].friction) * d;
        });
        if (at.normal != nullptr)
            for_each_pair([&](std::size_t e, const Vector& d) { return product(at.normal[e], d); });
    }
    std::copy(y, y + n_a, left<Vector>(*this).data() + group.slot_a);
    std::copy(y + n_a, y + n, left<Vector>(*this).data() + group.slot_b);
}

template <class Vector> void ContactOperator::add_to_cell(int cell, std::span<Vector> out) const {
    const auto& left = ContactOperator::left<Vector>(*this);
    for (std::size_t slot = first_slot_[idx(cell)]; slot < first_slot_[idx(cell) + 1]; ++slot)
        out[slot_node_[slot]] += left[slot];
}

template void ContactOperator::product_of_group(int, const Model&, Part, std::span<const Vec3>);
template void ContactOperator::product_of_group(int, const Model&, Part, std::span<const Lanes>);
template void ContactOperator::add_to_cell(int, std::span<Vec3>) const;
template void ContactOperator::add_to_cell(int, std::span<Lanes>) const;

Mat3 ContactOperator::sum_of(int g) const {
    const View at = view(groups_[idx(g)]);
    Mat3 sum = Mat3::Zero();
    for (int e = 0; e < at.row_begin[at.n_a]; ++e) sum += at.pairs[e].combined.mat3();
    return sum;
}

void ContactOperator::add_diagonal(int cell, const Contacts& contacts,
                                   std::span<Mat3> blocks) const {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const View at = view(groups_[idx(side.group)]);
        for (std::size_t a = 0; a < at.n_a; ++a)
            for (int e = at.row_begin[a]; e < at.row_begin[a + 1]; ++e) {
                const NodePair& pair = at.pairs[e];
                Mat3& block = blocks[side.is_a ? at.nodes_a[a] : at.nodes_b[pair.b - at.n_a]];
                if (stiffness_kPa_s_per_um_ > 0.0) {
                    block += pair.combined.mat3();
                    continue;
                }
                block.diagonal().array() += static_cast<double>(pair.friction);
                if (at.normal != nullptr) block += at.normal[e].mat3();
            }
    }
}

void ContactOperator::add_own_stiffness(int cell, const Contacts& contacts,
                                        double stiffness_kPa_s_per_um, CellMatrix& matrix) {
    for (const Contacts::Side& side : contacts.sides_of(cell)) {
        const Contacts::Group& group = contacts.groups[idx(side.group)];
        for (const ContactPair& pair : Contacts::pairs_of(group))
            matrix.add_between(side.is_a ? pair.triangle_a : pair.triangle_b,
                               side.is_a ? pair.lambda : pair.mu, pair.normal,
                               stiffness_kPa_s_per_um * pair.area_um2);
    }
}

}  // namespace spheroscope
