#include "engine/inspect/contact_report.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace spheroscope::inspect {

std::string ContactKey::text() const {
    return std::to_string(cell_a) + "-" + std::to_string(cell_b);
}

ContactKey parse_contact(const std::string& text) {
    const char *begin = text.data(), *end = begin + text.size();
    int a = -1, b = -1;
    const auto first = std::from_chars(begin, end, a);
    bool is_pair = first.ec == std::errc() && first.ptr != end && *first.ptr == '-';
    if (is_pair) {
        const auto second = std::from_chars(first.ptr + 1, end, b);
        is_pair = second.ec == std::errc() && second.ptr == end && a >= 0 && b >= 0;
    }
    if (!is_pair) throw Error("a contact wants two cells, for instance 17-42, got '" + text + "'");
    if (a == b) throw Error("a contact wants two different cells, got '" + text + "'");
    return {std::min(a, b), std::max(a, b)};
}

std::span<const Quantity> all_quantities() {
    using S = ContactSummary;
    static constexpr std::array<Quantity, 12> rows{{
        {"normal_force_nN", "nN", "normal force", &S::normal_force_nN},
        {"shear_force_nN", "nN", "shear force", &S::shear_force_nN},
        {"centre_force_nN", "nN", "force along centres", &S::centre_force_nN},
        {"area_um2", "µm²", "area", &S::area_um2},
        {"mean_overlap_um", "µm", "mean overlap", &S::mean_overlap_um},
        {"largest_overlap_um", "µm", "largest overlap", &S::largest_overlap_um},
        {"mean_overlap_h0", "h₀", "mean overlap", &S::mean_overlap_h0},
        {"largest_overlap_h0", "h₀", "largest overlap", &S::largest_overlap_h0},
        {"sigma_nn_low_kPa", "kPa", "lowest σ^c_nn", &S::sigma_nn_low_kPa},
        {"sigma_nn_high_kPa", "kPa", "highest σ^c_nn", &S::sigma_nn_high_kPa},
        {"Z_a", "", "contacts of A", &S::Z_a},
        {"Z_b", "", "contacts of B", &S::Z_b},
    }};
    return rows;
}

double value_of(const Quantity& quantity, const ContactSummary& summary) {
    return std::visit([&](auto member) { return static_cast<double>(summary.*member); },
                      quantity.member);
}

}  // namespace spheroscope::inspect
