#include "engine/forces/contact_traction.hpp"

#include "engine/forces/contact_pairs.hpp"

namespace spheroscope {

void ContactTraction::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    add_pair_forces(at, cell, F_nN);
}

std::optional<double> ContactTraction::energy_fJ(const Configuration& at, int cell) const {
    double energy_fJ = 0.0;
    for (const Contacts::Side& side : at.contacts.sides_of(cell))
        for (const ContactPair& pair :
             at.contacts.pairs_of(at.contacts.groups[static_cast<std::size_t>(side.group)]))
            energy_fJ += 0.5 * pair.energy_fJ;
    return energy_fJ;
}

}  // namespace spheroscope
