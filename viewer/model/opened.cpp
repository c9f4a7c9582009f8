#include "viewer/model/opened.hpp"

namespace spheroscope::viewer {

std::string key_text(const Opened& opened) {
    if (const auto* contact = std::get_if<inspect::ContactKey>(&opened)) return contact->text();
    return std::get<NodeOfCell>(opened).text();
}

std::string text_of(const Opened& opened) {
    const bool is_contact = std::holds_alternative<inspect::ContactKey>(opened);
    return (is_contact ? "contact " : "node ") + key_text(opened);
}

std::optional<inspect::ContactKey> contact_of(const std::optional<Opened>& opened) {
    if (!opened || !std::holds_alternative<inspect::ContactKey>(*opened)) return {};
    return std::get<inspect::ContactKey>(*opened);
}

}  // namespace spheroscope::viewer
