#include "engine/scene/key_text.hpp"
#include "engine/scene/keys.hpp"

#include <fmt/format.h>

namespace spheroscope::scene {
namespace {

/// A cell of a Markdown table must not contain its separator.
std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string presence_text(const Table& table) {
    using Presence = Table::Presence;
    std::string text;
    switch (table.presence) {
    case Presence::required: text = "Required."; break;
    case Presence::standard: text = "May be left out: every key has a default."; break;
    case Presence::part:
        text = "A part of the run: without this table nothing of it is there.";
        break;
    case Presence::list: text = "A list: each item has a header of its own."; break;
    case Presence::named: text = "Any number of them, under their names."; break;
    }
    if (!table.applies.words.empty()) text += fmt::format(" Belongs {}.", table.applies.words);
    return text;
}

std::string default_text(Draft& draft, const Key& key) {
    using Rule = WhenAbsent::Rule;
    switch (key.absent.rule) {
    case Rule::required: return "required";
    case Rule::computed: return std::string(key.absent.words);
    case Rule::one_of:
    case Rule::input_of: return fmt::format("exactly one of {}", key.absent.words);
    case Rule::optional_input: return "";
    case Rule::standard: break;
    }
    const std::string value = value_text(draft, key, 0);
    return value.empty() ? "none" : fmt::format("`{}`", value);
}

std::string header(const Table& table) {
    if (table.presence == Table::Presence::list) return fmt::format("[[{}]]", table.path);
    if (table.presence == Table::Presence::named) return fmt::format("[{}.NAME]", table.path);
    return fmt::format("[{}]", table.path);
}

}  // namespace

std::string keys_markdown() {
    Document empty;
    Draft
        draft;  // its parts appear as their first key is reached, so defaults are the members' own
    draft.document = &empty;
    std::string text = "Whatever the range of a key, these are the largest sizes of its kind, and "
                       "the smallest where it cannot be zero:\n\n| kind | unit | smallest | "
                       "largest |\n|---|---|---|---|\n";
    for (const Dimension dimension : all_dimensions()) {
        const auto [smallest, largest] = size_limits(dimension);
        text += fmt::format("| {} | {} | {:g} | {:g} |\n", dimension_name(dimension),
                            engine_unit(dimension), smallest, largest);
    }
    text += "\n";
    for (const Table& table : all_tables()) {
        if (table.enter != nullptr) table.enter(draft, Loc{}, "NAME");
        text += fmt::format("### `{}`\n\n{} {}\n\n", header(table), table.description,
                            presence_text(table));
        text += "| key | type | range | default | applies | typical | source | meaning |\n"
                "|---|---|---|---|---|---|---|---|\n";
        for (const Key& key : all_keys()) {
            if (key.table != table.path) continue;
            text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} |\n", key.name,
                                cell(describe_type(key)), cell(key.bound.words),
                                cell(default_text(draft, key)), cell(key.applies.words),
                                cell(key.typical), cell(key.source), cell(key.description));
        }
        text += "\n";
    }
    return text;
}

}  // namespace spheroscope::scene
