#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

// What the parts of the SIMD kernel hand to each other: plain numbers and pointers, no containers.
// Code in a SIMD target must not instantiate templates of the standard library: the linker keeps
// one copy of those, and it could be the one with instructions that another machine lacks.

namespace spheroscope::lanes {

constexpr std::size_t k_max_lanes = 16;  ///< of one vector, in any target
constexpr std::size_t k_block = 16;      ///< triangles of B that are ruled out together
constexpr std::size_t k_record = 16;     ///< numbers of one triangle, see PackedTriangles
constexpr std::size_t k_used_of_record = 12;

/// Integer as wide as T.
template <class T> using IndexOf = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

/// The positions of the bits that are set in a byte, in front; the rest is 0.
template <class Index> struct SetBits {
    Index position[256][8];
    constexpr SetBits() : position{} {
        for (unsigned byte = 0; byte < 256; ++byte) {
            std::size_t n = 0;
            for (Index bit = 0; bit < 8; ++bit)
                if ((byte >> bit & 1U) != 0) position[byte][n++] = bit;
        }
    }
};
template <class Index> inline constexpr SetBits<Index> k_set_bits{};

/// Triangles of a cell, in their order.
template <class T> struct Side {
    const T* record;       ///< [n_triangles x k_record]
    const T* centroid[3];  ///< [n_triangles]
    const T* normal[3];    ///< [n_triangles]
    const T* reach;        ///< [n_triangles]
    T other_low[3];        ///< box of the other cell, relative to the origin of this one
    T other_high[3];
};

/// Two cells, and the law between them. The names are those of ContactLaw.
template <class T> struct Task {
    std::size_t n_triangles;
    Side<T> a, b;
    T offset[3];     ///< from the origin of A to the origin of B
    T direction[3];  ///< unit, from B towards A
    T reach;         ///< largest distance of two surfaces that make a contact
    T h0, P0, k, reject_cos, largest_overlap;
};

/// Room for intermediate lists.
template <class T> struct Buffers {
    IndexOf<T>* near_a;  ///< [n_triangles + k_block] triangles of A that can touch B
    IndexOf<T>* near_b;
    T* extent_a;  ///< [n_triangles + k_block] of near_a, towards B
    T* extent_b;
    T* centroid_b[3];  ///< [n_triangles + k_block] of near_b, relative to the origin of A
    T* normal_b[3];
    T* reach_b;
    T* block_centre[3];  ///< [n_triangles / k_block + k_max_lanes] spheres around k_block of near_b
    T* block_reach;
    IndexOf<T>* open_block;  ///< [n_triangles / k_block + k_max_lanes] near one triangle of A
    IndexOf<T>* survivor_a;  ///< [survivors]
    IndexOf<T>* survivor_b;
    std::size_t survivors;  ///< at least n_triangles + k_block
};

/// The numbers of an active pair, in this order in Batch::value.
enum Value : std::size_t {
    normal_x,
    normal_y,
    normal_z,
    area,
    force,
    force_a0,
    force_a1,
    force_b0,
    force_b1,
    lambda0,
    lambda1,
    mu0,
    mu1,
    energy,
    overlap,
    largest_overlap,
    n_values
};

/// Clipped pairs, one in each lane.
template <class T> struct Batch {
    std::size_t n;  ///< lanes in use
    const IndexOf<T>* triangle_a;
    const IndexOf<T>* triangle_b;
    std::uint64_t active;    ///< bit per lane
    std::uint64_t too_deep;  ///< bit per lane
    T value[n_values][k_max_lanes];
};

/// Takes the batches in order.
template <class T> struct Sink {
    void (*take)(void* self, const Batch<T>& batch);
    void* self;
};

}  // namespace spheroscope::lanes
