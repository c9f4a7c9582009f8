#pragma once

#include "engine/base/block3.hpp"
#include "engine/base/huge_vector.hpp"
#include "engine/base/workers.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/friction/contact_friction.hpp"
#include "engine/model/model.hpp"
#include "engine/solve/cell_matrix.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace spheroscope {

/// Friction and stiffness of all contacts between nodes of different cells: for every pair of
/// nodes that some pair of triangles connects, one number (friction) or one block (with dt times
/// the stiffness), summed over the pairs of triangles. There are about as many pairs of nodes as of
/// triangles, and each is a fraction of the work.
///
/// A product has two phases with a barrier between them. First every group (pair of cells) gathers
/// the values of the nodes that it touches into a small local array, works through its pairs there,
/// and leaves the result in a slot of either cell; then every cell adds what is in its slots, which
/// lie side by side in the order of the groups. Each pair is read once, nobody writes where another
/// one does, the sums have one order, and all long arrays are read from one end to the other.
/// Products exist in double precision (Vec3) and in single (Lanes); the sums are stored rounded to
/// single precision (relative error 6e-8) and act on differences of nodes, so the matrix is
/// symmetric and its friction blind to a common translation whatever the rounding.
class ContactOperator {
  public:
    /// friction: empty if the scene has none. stiffness_kPa_s_per_um: dt times k of the law; 0: no
    /// stiffness.
    void build(const Model& model, const Contacts& contacts,
               const std::optional<ContactFriction>& friction, double stiffness_kPa_s_per_um,
               Workers& workers);
    void clear() { n_groups_ = 0; }

    [[nodiscard]] int n_groups() const { return static_cast<int>(n_groups_); }
    [[nodiscard]] bool empty() const { return n_groups_ == 0; }

    enum class Part { friction, friction_and_stiffness };
    /// Phase 1, for one group.
    template <class Vector>
    void product_of_group(int group, const Model& model, Part part, std::span<const Vector> u);
    /// Phase 2, for one cell: out [n_nodes of the cell] += what its groups have left.
    template <class Vector> void add_to_cell(int cell, std::span<Vector> out) const;
    /// What holds the two cells of a group together when they move as wholes: the sum over its
    /// pairs, friction and stiffness. Precondition: built with a stiffness.
    [[nodiscard]] Mat3 sum_of(int group) const;
    /// Adds what friction and stiffness have between nodes of different cells to the 3x3 diagonal
    /// blocks of one cell.
    void add_diagonal(int cell, const Contacts& contacts, std::span<Mat3> blocks) const;
    /// The stiffness couples the nodes of a triangle among themselves, too: they share one spring.
    /// Without this part the springs resist more than they should, and slow creep is slower still.
    static void add_own_stiffness(int cell, const Contacts& contacts, double stiffness_kPa_s_per_um,
                                  CellMatrix& matrix);

  private:
    /// Node of A (the row it is in) with a node of B: one cache line holds two of them.
    struct NodePair {
        SymmetricBlock3 combined;  // friction and stiffness, if there is stiffness
        float friction;            // isotropic part, nN s/um
        std::uint16_t b;           // place among the group's nodes, after A's
    };
    /// The groups that a member builds, and later multiplies, one after the other.
    struct Arena {
        HugeVector<NodePair> pairs;
        HugeVector<SymmetricBlock3> normal;  // [pairs] rest of the friction, if it has a direction
        std::vector<int> row_begin;          // of each group [n_a + 1], into its pairs
        HugeVector<std::uint16_t> nodes;     // of each group [n_a + n_b]: A's, then B's
    };
    struct Group {
        int cell_a = 0, cell_b = 0;
        std::size_t n_a = 0, n_b = 0;                               // nodes that take part
        std::size_t arena = 0;                                      // where its arrays begin:
        std::size_t first_pair = 0, first_row = 0, first_node = 0;  // there,
        std::size_t slot_a = 0, slot_b = 0;                         // and among the slots
    };
    /// The group's arrays, wherever they are.
    struct View {
        std::size_t n_a;
        const NodePair* pairs;
        const SymmetricBlock3* normal;  // null: no direction
        const int* row_begin;
        const std::uint16_t* nodes_a;
        const std::uint16_t* nodes_b;
    };
    struct Scratch;
    void build_group(const Model& model, const Contacts::Group& source, Group& group,
                     Arena& arena) const;
    // Its steps: which nodes take part, which of them are connected, sums over the pairs of
    // triangles, and what products need of them.
    static void number_nodes(const MeshTopology& mesh, std::span<const ContactPair> pairs,
                             Group& group, Arena& arena, Scratch& scratch);
    static void connect_nodes(const Group& group, Arena& arena, Scratch& scratch);
    void add_up(std::span<const ContactPair> pairs, const Group& group, const Arena& arena,
                Scratch& scratch) const;
    void write_blocks(const Group& group, Arena& arena, const Scratch& scratch) const;
    [[nodiscard]] double tangential_friction() const {
        return friction_ ? friction_->tangential_kPa_s_per_um : 0.0;
    }
    /// What the friction has more along the normal.
    [[nodiscard]] double normal_rest() const {
        return friction_ ? friction_->normal_kPa_s_per_um - tangential_friction() : 0.0;
    }
    /// Gives every cell a slot for each node of each of its groups.
    void lay_out_slots(const Contacts& contacts, int n_cells);
    [[nodiscard]] View view(const Group& group) const;
    /// [slots] What the groups have left for the nodes of their cells.
    template <class Vector, class Self> static auto& left(Self& self) {
        if constexpr (std::is_same_v<Vector, Lanes>)
            return self.left_in_single_;
        else
            return self.left_in_double_;
    }

    std::optional<ContactFriction> friction_;
    double stiffness_kPa_s_per_um_ = 0.0;  // 0: the pairs have no `combined`
    std::vector<Group> groups_;
    std::size_t n_groups_ = 0;             // in use
    std::vector<Arena> arenas_;            // [members]
    std::vector<std::size_t> first_slot_;  // [cells + 1]
    HugeVector<std::uint16_t> slot_node_;  // [slots] node of the cell
    HugeVector<Vec3> left_in_double_;
    HugeVector<Lanes> left_in_single_;
};

}  // namespace spheroscope
