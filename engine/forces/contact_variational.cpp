#include "engine/forces/contact_variational.hpp"

#include "engine/forces/active_tension.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/contact_pairs.hpp"

namespace spheroscope {

std::array<Vec3, 3> film_forces_nN(const Configuration& at, int cell, const ContactFilm& film) {
    const CellView view(at, cell);
    const auto t = static_cast<std::size_t>(film.triangle);
    const auto& [i, j, k] = view.mesh.triangles[t];
    const Vec3& n = at.geometry.normal[view.first_triangle + t];
    const double tension = film.tension_nN_per_um;
    return {tension_force_nN(tension, view.x(j), view.x(k), n),
            tension_force_nN(tension, view.x(k), view.x(i), n),
            tension_force_nN(tension, view.x(i), view.x(j), n)};
}

void ContactVariational::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    add_pair_forces(at, cell, F_nN);
    for (const Contacts::Side& side : at.contacts.sides_of(cell)) {
        const auto& group = at.contacts.groups[static_cast<std::size_t>(side.group)];
        for (const ContactFilm& film : at.contacts.films_of(group, side.is_a)) {
            const auto& nodes =
                at.model.topology->triangles[static_cast<std::size_t>(film.triangle)];
            const std::array<Vec3, 3> force = film_forces_nN(at, cell, film);
            for (std::size_t c = 0; c < 3; ++c) at_node(F_nN, nodes[c]) += force[c];
        }
    }
}

std::optional<double> ContactVariational::energy_fJ(const Configuration& at, int cell) const {
    double energy_fJ = 0.0;
    for (const Contacts::Side& side : at.contacts.sides_of(cell))
        for (const ContactFilm& film : at.contacts.films_of(
                 at.contacts.groups[static_cast<std::size_t>(side.group)], side.is_a))
            energy_fJ += film.energy_fJ;
    return energy_fJ;
}

}  // namespace spheroscope
