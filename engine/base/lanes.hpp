#pragma once

#include "engine/base/vec3.hpp"

#include <array>

namespace spheroscope {

/// A vector of space in four single-precision lanes (x, y, z, 0) that travel together: half the
/// memory of Vec3 and one instruction where Vec3 takes three. The iterations of a linear solver
/// work on these; what they converge to is checked in double precision. Every operation rounds
/// lane by lane as IEEE 754 says, so the bits are the same on every machine.
struct Lanes {
    // A vector type of GCC and Clang, native where the machine has four lanes (all x86-64, ARM64).
    using Register = float __attribute__((vector_size(16)));
    Register lane{0.0F, 0.0F, 0.0F, 0.0F};

    Lanes() = default;
    explicit Lanes(Register r) : lane(r) {}
    Lanes(float x, float y, float z) : lane{x, y, z, 0.0F} {}
    explicit Lanes(const Vec3& v)
        : lane{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
               0.0F} {}

    [[nodiscard]] static Lanes zero() { return {}; }
    [[nodiscard]] Vec3 vec3() const {
        return {static_cast<double>(lane[0]), static_cast<double>(lane[1]),
                static_cast<double>(lane[2])};
    }

    Lanes& operator+=(Lanes b) { return lane += b.lane, *this; }
    Lanes& operator-=(Lanes b) { return lane -= b.lane, *this; }
    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.lane + b.lane); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.lane - b.lane); }
    friend Lanes operator*(float s, Lanes a) { return Lanes(s * a.lane); }

    [[nodiscard]] float dot(Lanes b) const {
        const Register product = lane * b.lane;
        return (product[0] + product[1]) + product[2];
    }
};

/// What a product over elements needs to know of the vectors that it works on: Vec3 in double
/// precision, Lanes in single. The elements themselves are stored once, in single precision.
template <class Vector> struct VectorTraits;
template <> struct VectorTraits<Vec3> {
    using Scalar = double;
    static Vec3 zero() { return Vec3::Zero(); }
    static const Vec3& from(const Vec3& v) { return v; }
    static Vec3 from(const std::array<float, 3>& v) {
        return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
};
template <> struct VectorTraits<Lanes> {
    using Scalar = float;
    static Lanes zero() { return {}; }
    static Lanes from(const Vec3& v) { return Lanes(v); }
    static Lanes from(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
};

}  // namespace spheroscope
