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
    Vec3 normal;                 ///< n, from B to A
    Vec3 centroid_um;            ///< of the clip polygon, in the contact plane
    double area_um2;             ///< S_AB of the clip polygon
    double force_nN;             ///< integral of P: > 0 pushes A along +n, B along -n
    double energy_fJ;            ///< integral of e(delta)
    double overlap_um;           ///< mean delta over the polygon
    double largest_overlap_um;
    std::array<double, 3> lambda;      ///< barycentric coordinates of the centroid in A^p
    std::array<double, 3> mu;          ///< and in B^p
    std::array<double, 3> force_a_nN;  ///< f_i: node i of A feels + f_i n; sums to force_nN
    std::array<double, 3> force_b_nN;  ///< g_k: node k of B feels - g_k n
};

/// All active pairs of one configuration, grouped by pair of cells. Groups ascend by (cell_a,
/// cell_b), pairs in a group by (triangle_a, triangle_b): the order depends on nothing else, so
/// neither do sums.
struct Contacts {
    struct Group {
        int cell_a, cell_b;
        int begin, end;  ///< into `pairs`
    };
    struct Side {
        int group;
        bool is_a;  ///< the cell is cell_a of the group
    };
    std::vector<ContactPair> pairs;
    std::vector<Group> groups;     ///< only groups that have a pair
    std::vector<int> cell_begin;   ///< [n_cells + 1] into `cell_sides`
    std::vector<Side> cell_sides;  ///< the groups of each cell, ascending

    [[nodiscard]] std::span<const ContactPair> pairs_of(const Group& group) const {
        return std::span(pairs).subspan(static_cast<std::size_t>(group.begin),
                                        static_cast<std::size_t>(group.end - group.begin));
    }
    [[nodiscard]] std::span<const Side> sides_of(int cell) const {
        const auto begin = static_cast<std::size_t>(cell_begin[static_cast<std::size_t>(cell)]);
        const auto end = static_cast<std::size_t>(cell_begin[static_cast<std::size_t>(cell) + 1]);
        return std::span(cell_sides).subspan(begin, end - begin);
    }
    /// Fills cell_begin and cell_sides from `groups`.
    void index_sides(int n_cells);
    void clear(int n_cells) {
        pairs.clear();
        groups.clear();
        cell_sides.clear();
        cell_begin.assign(static_cast<std::size_t>(n_cells) + 1, 0);
    }
};

}  // namespace spheroscope
