#pragma once

#include "engine/base/lanes.hpp"
#include "engine/base/vec3.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace spheroscope {

/// L L^T of a sparse, symmetric, positive definite matrix. SuiteSparse's CHOLMOD (simplicial)
/// orders and factors it; the triangular solves here allocate nothing and may be called by several
/// threads at once.
class SparseCholesky {
  public:
    /// An element of the lower triangle, the diagonal included; those of one place are summed.
    struct Entry {
        int row, column;
        double value;
    };
    /// False, and no factor, when the n x n matrix is not positive definite.
    [[nodiscard]] bool factor(int n, std::span<const Entry> lower);

    /// x = matrix^-1 b, all [n]; work [n] is scratch. x may be b. Vector: double, or Vec3 and Lanes
    /// (in single precision) for three right-hand sides that go through together.
    template <class Vector>
    void solve(std::span<const Vector> b, std::span<Vector> x, std::span<Vector> work) const;

  private:
    /// The elements of L in the precision of a solve; on the diagonal, which comes first in its
    /// column, one over the element.
    template <class Scalar> [[nodiscard]] const Scalar* values() const {
        if constexpr (std::is_same_v<Scalar, float>)
            return value_single_.data();
        else
            return value_.data();
    }

    std::vector<int> permutation_;
    std::vector<int> column_begin_, row_;
    std::vector<double> value_;
    std::vector<float> value_single_;
};

}  // namespace spheroscope
