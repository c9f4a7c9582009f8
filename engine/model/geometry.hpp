#pragma once

#include "engine/base/vec3.hpp"
#include "engine/model/model.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// What a term or a measure reads; the plan unites the needs, and nothing else is computed.
enum class Need : unsigned {
    none = 0,
    triangles = 1U << 0U,  ///< normals, areas, centroids
    volumes = 1U << 1U,    ///< V and dV/dx
    contacts = 1U << 2U,   ///< contact pairs (needs triangles)
};
[[nodiscard]] constexpr Need operator|(Need a, Need b) {
    return static_cast<Need>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
[[nodiscard]] constexpr bool has(Need all, Need one) {
    return (static_cast<unsigned>(all) & static_cast<unsigned>(one)) != 0U;
}

/// Geometry of one configuration; arrays that nobody needs stay empty.
struct Geometry {
    std::vector<Vec3> normal;               ///< [all triangles] outward, unit
    std::vector<double> area_um2;           ///< [all triangles]
    std::vector<Vec3> centroid_um;          ///< [all triangles]
    std::vector<double> reach_um;           ///< [all triangles] largest distance centroid - corner
    std::vector<double> volume_um3;         ///< [cells]
    std::vector<Vec3> volume_gradient_um2;  ///< [all nodes] S_i = dV/dx_i
    std::vector<Vec3> centre_um;            ///< [cells] mean of the nodes

    /// Sizes the arrays that `needs` asks for.
    void allocate(const Model& model, Need needs);
    /// Fills one cell's part. Cells are independent of each other.
    void compute_cell(const Model& model, std::span<const Vec3> x_um, Need needs, int cell);
};

}  // namespace spheroscope
