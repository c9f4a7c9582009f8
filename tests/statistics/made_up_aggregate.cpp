#include "tests/statistics/made_up_aggregate.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::test {

statistics::Aggregate round_cells(const std::vector<Vec3>& centres_um, double radius_um,
                                  int n_nodes) {
    statistics::Aggregate aggregate{};
    aggregate.topology = make_icosphere(n_nodes);
    aggregate.centre_um = centres_um;
    const MeshTopology& mesh = *aggregate.topology;
    const std::size_t n = centres_um.size();
    for (const Vec3& centre : centres_um) {
        for (const Vec3& x : mesh.unit_shape) aggregate.x_um.emplace_back(centre + radius_um * x);
        for (const auto& t : mesh.triangles) {
            const auto at = [&](std::size_t k) {
                return mesh.unit_shape[static_cast<std::size_t>(t[k])];
            };
            aggregate.triangle_area_um2.push_back(0.5 * radius_um * radius_um *
                                                  (at(1) - at(0)).cross(at(2) - at(0)).norm());
        }
    }
    constexpr double no_contact = std::numeric_limits<double>::quiet_NaN();
    aggregate.radius_um.assign(n, radius_um);
    aggregate.volume_um3.assign(n, 4.0 / 3.0 * std::numbers::pi * std::pow(radius_um, 3));
    aggregate.sigma_h_kPa.assign(n, 0.0);
    aggregate.anisotropic_max_kPa.assign(n, no_contact);
    aggregate.anisotropic_mean_kPa.assign(n, no_contact);
    aggregate.sigma_nn_kPa.assign(aggregate.triangle_area_um2.size(), no_contact);
    aggregate.shear_kPa = aggregate.sigma_nn_kPa;
    aggregate.gamma_eff_nN_per_um.assign(aggregate.x_um.size(), 0.0);
    statistics::finish_aggregate(aggregate);
    return aggregate;
}

}  // namespace spheroscope::test
