#include "engine/scene/key_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

std::string text_of(double value, Dimension dimension) {
    if (!std::isfinite(value)) return "";
    const std::string text = format_quantity(value, dimension);
    return engine_unit(dimension).empty() ? text : toml_string(text);
}
std::string text_of(int value, Dimension) { return fmt::format("{}", value); }
std::string text_of(std::uint64_t value, Dimension) { return fmt::format("{}", value); }
std::string text_of(bool value, Dimension) { return value ? "true" : "false"; }
std::string text_of(const std::string& value, Dimension) { return toml_string(value); }

template <class List> std::string text_of(const List& list, Dimension dimension) {
    std::string text;
    for (const auto& item : list)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", text_of(item, dimension));
    return "[" + text + "]";
}

}  // namespace

std::string toml_string(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += fmt::format("\\{}", c);
        else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            quoted += c;
    }
    return quoted + "\"";
}

std::string value_text(Draft& draft, const Key& key, std::size_t item) {
    if (const Choice* choice = std::get_if<Choice>(&key.access))
        return toml_string(
            std::string(choice->words[static_cast<std::size_t>(choice->get(draft, item))]));
    std::string text;
    std::visit(
        [&](const auto& access) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(access)>, Choice>)
                text = text_of(access(draft, item), key.dimension);
        },
        key.access);
    return text;
}

}  // namespace spheroscope::scene
