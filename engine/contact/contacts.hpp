#pragma once

#include "engine/base/vec3.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// Two triangles of two cells that act on each other, with everything that later readers use:
/// forces, friction, stiffness, and the measures. Triangle A belongs to the cell with the smaller
/// index.
struct ContactPair {
    int triangle_a, triangle_b;  ///< local to their cells
    float overlap_um;            ///< mean delta over the polygon
    float largest_overlap_um;
    Vec3 normal;                       ///< n, from B to A
    double area_um2;                   ///< S_AB of the clip polygon
    double energy_fJ;                  ///< integral of e(delta); `variational` has it in films
    std::array<double, 3> lambda;      ///< barycentric coordinates of the polygon's centroid in A^p
    std::array<double, 3> mu;          ///< and in B^p
    std::array<double, 3> force_a_nN;  ///< f_i: node i of A feels + f_i n
    std::array<double, 3> force_b_nN;  ///< g_k: node k of B feels - g_k n; the same sum

    /// Integral of P: > 0 pushes A along +n, B along -n.
    [[nodiscard]] double force_nN() const { return force_a_nN[0] + force_a_nN[1] + force_a_nN[2]; }
};

/// Law `variational`: in-plane tension of one triangle from its contact with one other cell, the
/// part of -dE/dx that comes from the triangle's area. It makes no net force and no torque.
struct ContactFilm {
    int triangle;              ///< local to its cell
    double tension_nN_per_um;  ///< < 0: adhesion spreads the triangle
    double energy_fJ;          ///< of this triangle's side of the contact
};

/// All active pairs of one configuration, grouped by pair of cells. Groups ascend by (cell_a,
/// cell_b), pairs in a group by (triangle_a, triangle_b), or in law `variational` by the triangle
/// whose surface they integrate: the order depends on nothing else, so neither do sums.
struct Contacts {
    struct Group {
        int cell_a = 0, cell_b = 0;
        std::vector<ContactPair> pairs;
        std::vector<ContactFilm> films_a{}, films_b{};  ///< of either cell; law `variational` only
    };
    struct Side {
        int group;
        bool is_a;  ///< the cell is cell_a of the group
    };
    std::vector<Group> groups;     ///< only groups that have a pair
    std::vector<int> cell_begin;   ///< [n_cells + 1] into `cell_sides`
    std::vector<Side> cell_sides;  ///< the groups of each cell, ascending

    [[nodiscard]] static std::span<const ContactPair> pairs_of(const Group& group) {
        return group.pairs;
    }
    [[nodiscard]] static std::span<const ContactFilm> films_of(const Group& group, bool is_a) {
        return is_a ? group.films_a : group.films_b;
    }
    [[nodiscard]] std::size_t n_pairs() const {
        std::size_t n = 0;
        for (const Group& group : groups) n += group.pairs.size();
        return n;
    }
    [[nodiscard]] std::span<const Side> sides_of(int cell) const {
        const auto begin = static_cast<std::size_t>(cell_begin[static_cast<std::size_t>(cell)]);
        const auto end = static_cast<std::size_t>(cell_begin[static_cast<std::size_t>(cell) + 1]);
        return std::span(cell_sides).subspan(begin, end - begin);
    }
    /// Fills cell_begin and cell_sides from `groups`.
    void index_sides(int n_cells);
    void clear(int n_cells) {
        groups.clear();
        cell_sides.clear();
        cell_begin.assign(static_cast<std::size_t>(n_cells) + 1, 0);
    }
};

}  // namespace spheroscope
