#pragma once

#include "engine/base/lanes.hpp"
#include "engine/base/workers.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/friction/contact_friction.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace spheroscope {

/// Friction and stiffness of all contacts, applied without a matrix.
///
/// A product has two phases with a barrier between them. First every group (pair of cells) gathers
/// the values of the nodes that it touches into a small local array, works through its pairs there,
/// and leaves the result in another one; then every cell adds what its groups have left, in the
/// order of the groups. Each pair is read once, nobody writes where another one does, and the sums
/// have one order. Products exist in double precision (Vec3) and in single (Lanes); the numbers of
/// a pair are stored once, rounded to single precision (relative error 6e-8), such that the graph
/// of its friction stays blind to a common translation.
class ContactOperator {
  public:
    /// friction: empty if the scene has none. stiffness_kPa_per_um: k of the law; 0: no stiffness.
    void build(const Model& model, const Contacts& contacts,
               const std::optional<ContactFriction>& friction, double stiffness_kPa_per_um,
               Workers& workers);
    void clear();

    [[nodiscard]] int n_groups() const { return static_cast<int>(n_groups_); }

    /// Phase 1, for one group. The product is (friction + dt_s * stiffness) u.
    template <class Vector>
    void product_of_group(int group, const Model& model, double dt_s, std::span<const Vector> u);
    /// Phase 2, for one cell: out [n_nodes of the cell] += what its groups have left.
    template <class Vector>
    void add_to_cell(int cell, const Contacts& contacts, std::span<Vector> out) const;
    /// Adds the 3x3 diagonal blocks of one cell.
    void add_diagonal(int cell, const Contacts& contacts, double dt_s,
                      std::span<Mat3> blocks) const;
    [[nodiscard]] bool empty() const { return n_groups_ == 0; }

  private:
    struct Element {
        std::array<std::uint16_t, 3> a, b;  // into the group's local arrays; b after A's nodes
        std::array<float, 2> lambda, mu;    // the third is what is missing to 1
        std::array<float, 3> normal;
        float tangential;    // S g_t / 6, nN s/um
        float normal_extra;  // S (g_n - g_t) / 6
        float stiffness;     // S k, nN/um
    };
    template <class Vector> struct Local {
        std::vector<Vector> u, y;  // A's nodes, then B's
    };
    struct Group {
        int cell_a = 0, cell_b = 0;
        std::vector<int> nodes_a, nodes_b;  // local array -> node of the cell
        std::vector<Element> elements;
        Local<Vec3> in_double;
        Local<Lanes> in_single;
        template <class Vector> auto& local() {
            if constexpr (std::is_same_v<Vector, Lanes>)
                return in_single;
            else
                return in_double;
        }
        template <class Vector> const auto& local() const {
            return const_cast<Group*>(this)->local<Vector>();
        }
    };
    void build_group(const Model& model, const Contacts& contacts, const Contacts::Group& source,
                     Group& group) const;

    std::optional<ContactFriction> friction_;
    double stiffness_kPa_per_um_ = 0.0;
    std::vector<Group> groups_;
    std::size_t n_groups_ = 0;  // in use; the others keep their memory
};

}  // namespace spheroscope
