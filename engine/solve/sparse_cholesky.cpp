#include "engine/solve/sparse_cholesky.hpp"

#include "engine/base/index.hpp"

#include <cholmod.h>

#include <memory>

namespace spheroscope {
namespace {

/// CHOLMOD's common block, started and finished.
struct Common {
    cholmod_common c{};
    Common() {
        cholmod_start(&c);
        c.supernodal =
            CHOLMOD_SIMPLICIAL;  // the supernodal part is GPL, and no faster at these sizes
        c.final_ll = 1;
        c.final_pack = 1;
        c.final_monotonic = 1;
        c.print = 0;
    }
    ~Common() { cholmod_finish(&c); }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;
};

template <class Vector> struct ScalarOf { using Type = typename VectorTraits<Vector>::Scalar; };
template <> struct ScalarOf<double> { using Type = double; };

template <class Vector> Vector zero_of() { return VectorTraits<Vector>::zero(); }
template <> double zero_of<double>() { return 0.0; }

}  // namespace

bool SparseCholesky::factor(int n, std::span<const Entry> lower) {
    permutation_.clear();
    column_begin_.assign(1, 0);
    row_.clear();
    value_.clear();
    Common common;
    const auto free_sparse = [&](cholmod_sparse* m) { cholmod_free_sparse(&m, &common.c); };
    const auto free_triplet = [&](cholmod_triplet* m) { cholmod_free_triplet(&m, &common.c); };
    const auto free_factor = [&](cholmod_factor* m) { cholmod_free_factor(&m, &common.c); };
    const std::unique_ptr<cholmod_triplet, decltype(free_triplet)> triplet(
        cholmod_allocate_triplet(idx(n), idx(n), lower.size(), -1, CHOLMOD_REAL, &common.c),
        free_triplet);
    for (std::size_t k = 0; k < lower.size(); ++k) {
        static_cast<int*>(triplet->i)[k] = lower[k].row;
        static_cast<int*>(triplet->j)[k] = lower[k].column;
        static_cast<double*>(triplet->x)[k] = lower[k].value;
    }
    triplet->nnz = lower.size();
    const std::unique_ptr<cholmod_sparse, decltype(free_sparse)> matrix(
        cholmod_triplet_to_sparse(triplet.get(), lower.size(), &common.c), free_sparse);
    const std::unique_ptr<cholmod_factor, decltype(free_factor)> factor(
        cholmod_analyze(matrix.get(), &common.c), free_factor);
    cholmod_factorize(matrix.get(), factor.get(), &common.c);
    if (common.c.status != CHOLMOD_OK || factor->is_ll == 0 || factor->is_monotonic == 0)
        return false;

    const auto* begin = static_cast<const int*>(factor->p);
    const auto* count = static_cast<const int*>(factor->nz);
    const auto* row = static_cast<const int*>(factor->i);
    const auto* value = static_cast<const double*>(factor->x);
    const auto* perm = static_cast<const int*>(factor->Perm);
    permutation_.assign(perm, perm + n);
    for (std::size_t column = 0; column < idx(n); ++column) {
        row_.insert(row_.end(), row + begin[column], row + begin[column] + count[column]);
        value_.push_back(1.0 / value[begin[column]]);
        value_.insert(value_.end(), value + begin[column] + 1,
                      value + begin[column] + count[column]);
        column_begin_.push_back(static_cast<int>(row_.size()));
    }
    value_single_.assign(value_.begin(), value_.end());
    return true;
}

template <class Vector> void SparseCholesky::solve(std::span<const Vector> b, std::span<Vector> x,
                                                   std::span<Vector> work) const {
    using Scalar = typename ScalarOf<Vector>::Type;
    const Scalar* const value = values<Scalar>();
    const std::size_t n = permutation_.size();
    for (std::size_t i = 0; i < n; ++i) work[i] = b[idx(permutation_[i])];
    for (std::size_t column = 0; column < n; ++column) {  // L y = b
        const std::size_t first = idx(column_begin_[column]);
        const std::size_t end = idx(column_begin_[column + 1]);
        const Vector y = value[first] * work[column];
        work[column] = y;
        for (std::size_t k = first + 1; k < end; ++k) work[idx(row_[k])] -= value[k] * y;
    }
    for (std::size_t column = n; column-- > 0;) {  // L^T z = y
        const std::size_t first = idx(column_begin_[column]);
        const std::size_t end = idx(column_begin_[column + 1]);
        // two sums: neither has to wait for the other's last addition
        Vector even = work[column], odd = zero_of<Vector>();
        std::size_t k = first + 1;
        for (; k + 1 < end; k += 2) {
            even -= value[k] * work[idx(row_[k])];
            odd -= value[k + 1] * work[idx(row_[k + 1])];
        }
        if (k < end) even -= value[k] * work[idx(row_[k])];
        work[column] = value[first] * Vector(even + odd);
    }
    for (std::size_t i = 0; i < n; ++i) x[idx(permutation_[i])] = work[i];
}

template void SparseCholesky::solve(std::span<const double>, std::span<double>,
                                    std::span<double>) const;
template void SparseCholesky::solve(std::span<const Vec3>, std::span<Vec3>, std::span<Vec3>) const;
template void SparseCholesky::solve(std::span<const Lanes>, std::span<Lanes>,
                                    std::span<Lanes>) const;

}  // namespace spheroscope
