#pragma once

#include "engine/contact/contact_law.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <span>

namespace spheroscope::reference {

/// Every triangle of every cell against every triangle of every other one: no lists, no boxes.
/// `geometry` holds the triangles of x_um [all nodes].
[[nodiscard]] Contacts contacts_of_all_pairs(const Model& model, std::span<const Vec3> x_um,
                                             const Geometry& geometry, const ContactLaw& law);

}  // namespace spheroscope::reference
