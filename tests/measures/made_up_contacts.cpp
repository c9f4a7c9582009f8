#include "tests/measures/made_up_contacts.hpp"

namespace spheroscope::test {

MadeUpContacts::MadeUpContacts(const std::vector<Vec3>& centres_um)
    : model(make_model(make_icosphere(42), std::vector<double>(centres_um.size(), 5.0))),
      x_um(turned_cells(model, centres_um, 31)), v_um_per_s(x_um.size(), Vec3::Zero()),
      volume_integral_s(centres_um.size(), 0.0), pressure_kPa(centres_um.size(), 0.1) {
    set({});
}

void MadeUpContacts::set(const std::vector<Push>& pushes) {
    geometry = geometry_of(model, x_um, Need::triangles | Need::volumes);
    contacts.clear(model.n_cells());
    for (const Push& push : pushes) {
        ContactPair pair{};
        pair.triangle_a = push.triangle_a;
        pair.triangle_b = push.triangle_b;
        pair.normal = push.normal;
        pair.area_um2 = push.area_um2;
        pair.force_a_nN = push.force_a_nN;
        pair.force_b_nN = push.force_b_nN;
        const bool is_new_group = contacts.groups.empty() ||
                                  contacts.groups.back().cell_a != push.cell_a ||
                                  contacts.groups.back().cell_b != push.cell_b;
        if (is_new_group) contacts.groups.push_back({push.cell_a, push.cell_b, {}});
        contacts.groups.back().pairs.push_back(pair);
    }
    contacts.index_sides(model.n_cells());
    stress_kPa = cell_stress_tensors(at());
}

MeasureInput MadeUpContacts::input(const Configuration& configuration) {
    MeasureInput input{.at = configuration,
                       .v_um_per_s = v_um_per_s,
                       .spring_nN_per_um = {},
                       .pressure_kPa = pressure_kPa,
                       .cell_stress_kPa = stress_kPa};
    return input;
}

}  // namespace spheroscope::test
