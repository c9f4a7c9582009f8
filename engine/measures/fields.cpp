#include "engine/measures/fields.hpp"

#include "engine/measures/field_functions.hpp"

#include <array>

namespace spheroscope {

std::span<const Field> all_fields() {
    using enum RangeKind;
    static constexpr std::string_view paper = "Cuvelier et al. 2021";
    static constexpr std::array<Field, 17> rows{{
        {"sigma_h", "σ^h", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "hydrostatic stress of a cell, from its contact forces; tension positive",
         "Cuvelier et al. 2021, eqn (4)", compute_sigma_h, Requires::contact},
        {"sigma_nn", "σ^c_nn", "kPa", "Pa", 1e3, Place::triangle, signed_about_zero, "no contact",
         "normal stress of the contacts on a triangle; tension positive",
         "Cuvelier et al. 2021, eqn (3)", compute_sigma_nn, Requires::contact},
        {"gamma_eff", "γ^eff", "nN/um", "mN/m", 1.0, Place::node, signed_about_zero, "",
         "elastic part of the surface tension at a node", "Cuvelier et al. 2021, eqn (2)",
         compute_gamma_eff, Requires::elastic},
        {"gamma_total", "γ + γ^eff", "nN/um", "mN/m", 1.0, Place::node, magnitude, "",
         "surface tension at a node, active and elastic; without that of the strain limiter",
         "Cuvelier et al. 2021, eqn (2)", compute_gamma_total, Requires::nothing},
        {"shear", "σ^c_t", "kPa", "Pa", 1e3, Place::triangle, magnitude, "no contact",
         "shear stress of the contacts on a triangle", paper, compute_shear, Requires::contact},
        {"sigma_radial", "σ_rr", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "at the centre",
         "stress of a cell along the line to the aggregate's centre", paper, compute_sigma_radial,
         Requires::contact},
        {"sigma_tangential", "σ_tt", "kPa", "Pa", 1e3, Place::cell, signed_about_zero,
         "at the centre", "mean stress of a cell across the line to the aggregate's centre", paper,
         compute_sigma_tangential, Requires::contact},
        {"anisotropic_max", "Δσ_max", "kPa", "Pa", 1e3, Place::cell, magnitude, "no contact",
         "95th minus 5th percentile of sigma_nn over a cell's touching triangles, unweighted",
         paper, compute_anisotropic_max, Requires::contact},
        {"anisotropic_mean", "Δσ", "kPa", "Pa", 1e3, Place::cell, magnitude, "no contact",
         "standard deviation of sigma_nn over a cell's touching triangles, unweighted", paper,
         compute_anisotropic_mean, Requires::contact},
        {"pressure", "P", "kPa", "Pa", 1e3, Place::cell, magnitude, "",
         "pressure of the cytosol over the medium", "Cuvelier et al. 2021, eqns (12), (13)",
         compute_pressure, Requires::cytosol},
        {"neighbours", "Z_i", "1", "", 1.0, Place::cell, magnitude, "",
         "number of cells that a cell touches", paper, compute_neighbours, Requires::contact},
        {"stress_xx", "σ_xx", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_xx, Requires::contact},
        {"stress_yy", "σ_yy", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_yy, Requires::contact},
        {"stress_zz", "σ_zz", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_zz, Requires::contact},
        {"stress_xy", "σ_xy", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_xy, Requires::contact},
        {"stress_xz", "σ_xz", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_xz, Requires::contact},
        {"stress_yz", "σ_yz", "kPa", "Pa", 1e3, Place::cell, signed_about_zero, "",
         "component of the stress of a cell, from its contact forces",
         "Cuvelier et al. 2021, eqn (4)", compute_stress_yz, Requires::contact},
    }};
    return rows;
}

bool is_tension_or_compression(const Field& field) {
    const bool is_shear =
        field.name == "stress_xy" || field.name == "stress_xz" || field.name == "stress_yz";
    return field.range == RangeKind::signed_about_zero && !is_shear;
}

const Field* find_field(std::string_view name) {
    for (const Field& field : all_fields())
        if (field.name == name) return &field;
    return nullptr;
}

}  // namespace spheroscope
