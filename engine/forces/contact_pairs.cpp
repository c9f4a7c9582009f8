#include "engine/forces/contact_pairs.hpp"

namespace spheroscope {

void add_pair_forces(const Configuration& at, int cell, std::span<Vec3> F_nN) {
    const MeshTopology& mesh = *at.model.topology;
    for (const Contacts::Side& side : at.contacts.sides_of(cell)) {
        const auto& group = at.contacts.groups[static_cast<std::size_t>(side.group)];
        for (const ContactPair& pair : at.contacts.pairs_of(group)) {
            const int triangle = side.is_a ? pair.triangle_a : pair.triangle_b;
            const auto& nodes = mesh.triangles[static_cast<std::size_t>(triangle)];
            const auto& magnitude = side.is_a ? pair.force_a_nN : pair.force_b_nN;
            const double sign = side.is_a ? 1.0 : -1.0;
            for (std::size_t i = 0; i < 3; ++i)
                F_nN[static_cast<std::size_t>(nodes[i])] += (sign * magnitude[i]) * pair.normal;
        }
    }
}

}  // namespace spheroscope
