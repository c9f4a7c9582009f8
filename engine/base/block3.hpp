#pragma once

#include "engine/base/lanes.hpp"

#include <array>
#include <cstring>

namespace spheroscope {

/// A 3x3 block of a matrix in single precision, column by column: what couples two nodes of a cell.
/// Its products exist for vectors in double precision (Vec3) and in single (Lanes).
struct Block3 {
    std::array<float, 9> column_major{};

    void add_isotropic(float value) {
        column_major[0] += value;
        column_major[4] += value;
        column_major[8] += value;
    }
    [[nodiscard]] Mat3 mat3() const {
        return Eigen::Map<const Eigen::Matrix3f>(column_major.data()).cast<double>();
    }
};

/// A symmetric one: xx, yy, zz, xy, xz, yz.
struct SymmetricBlock3 {
    std::array<float, 6> entry{};

    [[nodiscard]] Mat3 mat3() const {
        const auto at = [this](std::size_t k) { return static_cast<double>(entry[k]); };
        Mat3 m;
        m << at(0), at(3), at(4), at(3), at(1), at(5), at(4), at(5), at(2);
        return m;
    }
};

/// Both products of a block with one vector: B d and B^T d.
template <class Vector> struct BlockProducts { Vector straight, transposed; };

inline BlockProducts<Vec3> products(const Block3& block, const Vec3& d) {
    const Mat3 m = block.mat3();
    return {m * d, m.transpose() * d};
}

inline Vec3 product(const SymmetricBlock3& block, const Vec3& d) { return block.mat3() * d; }

namespace lane_detail {

inline Lanes::Register load(const float* four) {
    Lanes::Register r;
    std::memcpy(&r, four, sizeof r);
    return r;
}
inline void store(Lanes::Register r, float* four) { std::memcpy(four, &r, sizeof r); }

}  // namespace lane_detail

/// b: the nine numbers of a block, column by column. The fourth lane of d must be 0; that of the
/// products is.
inline BlockProducts<Lanes> products(const float* b, Lanes d) {
    using Register = Lanes::Register;
    using Mask = int __attribute__((vector_size(16)));
    const Register u = d.lane;
    const Register c0 = lane_detail::load(b), c1 = lane_detail::load(b + 3);  // and one more float
    const Register last = lane_detail::load(b + 5);
    const Register c2 = __builtin_shufflevector(last, last, 1, 2, 3, 3);
    const Register straight = c0 * __builtin_shufflevector(u, u, 0, 0, 0, 0) +
                              c1 * __builtin_shufflevector(u, u, 1, 1, 1, 1) +
                              c2 * __builtin_shufflevector(u, u, 2, 2, 2, 2);
    constexpr Mask k_three{-1, -1, -1, 0};
    // Columns times d, added up across lanes.
    const Register p0 = c0 * u, p1 = c1 * u, p2 = c2 * u;
    const Register xy = __builtin_shufflevector(p0, p1, 0, 4, 1, 5);
    const Register zw = __builtin_shufflevector(p0, p1, 2, 6, 3, 7);
    const Register transposed = __builtin_shufflevector(xy, p2, 0, 1, 4, 7) +
                                __builtin_shufflevector(xy, p2, 2, 3, 5, 7) +
                                __builtin_shufflevector(zw, p2, 0, 1, 6, 7);
    return {Lanes(reinterpret_cast<Register>(reinterpret_cast<Mask>(straight) & k_three)),
            Lanes(transposed)};
}

inline Lanes product(const SymmetricBlock3& block, Lanes d) {
    using Register = Lanes::Register;
    const Register u = d.lane;
    const Register diagonal = lane_detail::load(block.entry.data());  // xx, yy, zz, xy
    const Register off = lane_detail::load(block.entry.data() + 2);   // zz, xy, xz, yz
    return Lanes(
        diagonal * u +
        __builtin_shufflevector(off, off, 1, 1, 2, 0) * __builtin_shufflevector(u, u, 1, 0, 0, 3) +
        __builtin_shufflevector(off, off, 2, 3, 3, 0) * __builtin_shufflevector(u, u, 2, 2, 1, 3));
}

}  // namespace spheroscope
