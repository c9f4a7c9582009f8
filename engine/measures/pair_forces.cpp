#include "engine/measures/pair_forces.hpp"

namespace spheroscope {

std::vector<PairForce> pair_forces(const Configuration& at) {
    std::vector<PairForce> rows;
    rows.reserve(at.contacts.groups.size());
    for (const Contacts::Group& group : at.contacts.groups) {
        Vec3 on_a = Vec3::Zero();
        double area_um2 = 0.0;
        for (const ContactPair& pair : at.contacts.pairs_of(group)) {
            on_a += pair.force_nN() * pair.normal;
            area_um2 += pair.area_um2;
        }
        const Vec3 direction = (at.geometry.centre_um[static_cast<std::size_t>(group.cell_a)] -
                                at.geometry.centre_um[static_cast<std::size_t>(group.cell_b)])
                                   .normalized();
        rows.push_back({group.cell_a, group.cell_b, on_a.dot(direction), area_um2});
    }
    return rows;
}

}  // namespace spheroscope
