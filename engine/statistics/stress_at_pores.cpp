#include "engine/statistics/stress_at_pores.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spheroscope::statistics {
namespace {

struct Sum {
    double force_nN = 0.0, area_um2 = 0.0;
    [[nodiscard]] double mean_kPa() const { return force_nN / area_um2; }  // 0/0: NaN
};

}  // namespace

StressAtPores stress_at_pores(const Aggregate& aggregate) {
    const MeshTopology& mesh = *aggregate.topology;
    const std::size_t n_triangles = mesh.triangles.size();
    Sum at_pores, elsewhere;
    std::vector<char> faces_pore(idx(mesh.n_nodes()));
    for (int cell = 0; cell < aggregate.n_cells(); ++cell) {
        if (!aggregate.is_core(cell)) continue;
        const double* sigma_nn_kPa = aggregate.sigma_nn_kPa.data() + idx(cell) * n_triangles;
        const double* area_um2 = aggregate.triangle_area_um2.data() + idx(cell) * n_triangles;
        std::fill(faces_pore.begin(), faces_pore.end(), char{0});
        for (std::size_t t = 0; t < n_triangles; ++t)
            if (std::isnan(sigma_nn_kPa[t]))
                for (const int node : mesh.triangles[t]) faces_pore[idx(node)] = 1;
        for (std::size_t t = 0; t < n_triangles; ++t) {
            if (std::isnan(sigma_nn_kPa[t])) continue;
            const auto& nodes = mesh.triangles[t];
            Sum& sum = std::any_of(nodes.begin(), nodes.end(),
                                   [&](int node) { return faces_pore[idx(node)] != 0; })
                           ? at_pores
                           : elsewhere;
            sum.force_nN += area_um2[t] * sigma_nn_kPa[t];
            sum.area_um2 += area_um2[t];
        }
    }
    return {at_pores.mean_kPa(), elsewhere.mean_kPa()};
}

}  // namespace spheroscope::statistics
