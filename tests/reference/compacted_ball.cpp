#include "tests/reference/compacted_ball.hpp"

#include "engine/base/random.hpp"

namespace spheroscope::test {

Cluster make_compacted_ball(int n_nodes, std::uint64_t seed, double gap_um, double noise_um) {
    constexpr double radius_um = 6.0;
    // Neighbours at 1.8 radii: between touching spheres and the confluence of polyhedra.
    const double step_um = 1.8 * radius_um / std::sqrt(2.0);
    std::vector<Vec3> centres_um{Vec3::Zero()};
    for (const double s : {-step_um, step_um})
        for (const double t : {-step_um, step_um})
            for (const Vec3& centre : {Vec3(s, t, 0.0), Vec3(s, 0.0, t), Vec3(0.0, s, t)})
                centres_um.push_back(centre);
    Cluster ball{
        make_model(make_icosphere(n_nodes), std::vector<double>(centres_um.size(), radius_um)), {}};
    ball.x_um = turned_cells(ball.model, centres_um, seed);
    const Random random(seed, 71);
    for (int cell = 0; cell < ball.model.n_cells(); ++cell) {
        const Vec3& own = centres_um[static_cast<std::size_t>(cell)];
        const std::span<Vec3> x = ball.model.cell_nodes(std::span<Vec3>(ball.x_um), cell);
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (const Vec3& other : centres_um) {
                const double distance_um = (other - own).norm();
                if (distance_um == 0.0) continue;
                const Vec3 towards = (other - own) / distance_um;
                const double beyond_um = towards.dot(x[i] - own) - 0.5 * (distance_um - gap_um);
                if (beyond_um > 0.0) x[i] -= beyond_um * towards;
            }
            const auto index = static_cast<std::uint64_t>(cell) * x.size() + i;
            for (std::uint32_t k = 0; k < 3; ++k)
                x[i][k] += noise_um * (2.0 * random.uniform(index, k) - 1.0);
        }
    }
    return ball;
}

}  // namespace spheroscope::test
