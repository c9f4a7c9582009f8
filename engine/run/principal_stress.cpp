#include "engine/run/principal_stress.hpp"

#include "engine/scene/scene.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace spheroscope {

std::optional<StressComponents> find_stress_components(const RunHeader& header) {
    StressComponents components{};
    for (std::size_t k = 0; k < components.size(); ++k) {
        const auto at =
            std::find_if(header.fields.begin(), header.fields.end(), [&](const Field* field) {
                return field->name == scene::k_stress_components[k];
            });
        if (at == header.fields.end()) return std::nullopt;
        components[k] = static_cast<std::size_t>(at - header.fields.begin());
    }
    return components;
}

PrincipalStress principal_stress(const Snapshot& snapshot, const StressComponents& components,
                                 int cell) {
    const auto part = [&](std::size_t k) {
        return double{snapshot.fields[components[k]][static_cast<std::size_t>(cell)]};
    };
    Mat3 stress;
    stress << part(0), part(3), part(4),  //
        part(3), part(1), part(5),        //
        part(4), part(5), part(2);
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(stress);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace spheroscope
