#include "engine/scene/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

namespace spheroscope::scene {
namespace {

Loc loc_from(const toml::source_position& position, const std::string& name) {
    return {name, static_cast<int>(position.line), static_cast<int>(position.column)};
}

Value value_from(const toml::node& node, const std::string& name) {
    Value value;
    value.loc = loc_from(node.source().begin, name);
    if (node.source().end.line == node.source().begin.line)
        value.end_column = static_cast<int>(node.source().end.column);
    if (const auto* text = node.as_string()) {
        value.kind = Value::Kind::text;
        value.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.kind = Value::Kind::integer;
        value.integer = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        value.kind = Value::Kind::number;
        value.number = number->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.kind = Value::Kind::boolean;
        value.boolean = boolean->get();
    } else if (const auto* list = node.as_array()) {
        value.kind = Value::Kind::list;
        for (const toml::node& item : *list) value.items.push_back(value_from(item, name));
    } else if (const auto* table = node.as_table()) {
        value.kind = Value::Kind::table;
        for (const auto& [key, item] : *table)
            value.entries.push_back({std::string(key.str()), loc_from(key.source().begin, name),
                                     value_from(item, name)});
        // toml++ sorts its keys by name; messages follow the file
        std::stable_sort(value.entries.begin(), value.entries.end(),
                         [](const Value::Entry& a, const Value::Entry& b) {
                             return std::pair(a.loc.line, a.loc.column) <
                                    std::pair(b.loc.line, b.loc.column);
                         });
    } else {
        value.kind = Value::Kind::other;
    }
    return value;
}

/// toml++'s description in the words of this program.
std::string syntax_message(std::string_view description) {
    constexpr std::string_view redefine = "cannot redefine existing ";
    const auto at = description.find(redefine);
    if (at == std::string_view::npos) return fmt::format("not valid TOML: {}", description);
    const auto open = description.find('\'', at);
    const auto close = description.find('\'', open + 1);
    if (open == std::string_view::npos || close == std::string_view::npos)
        return "this key is given twice, once as a value and once as a table";
    const std::string_view key = description.substr(open + 1, close - open - 1);
    if (description.substr(at + redefine.size()).starts_with("table"))
        return fmt::format("table [{}] is given twice", key);
    return fmt::format("key '{}' is given twice", key);
}

toml::table parse_toml(const std::string& text, const std::string& name) {
    try {
        return toml::parse(std::string_view(text), std::string_view(name));
    } catch (const toml::parse_error& error) {
        throw Error(loc_from(error.source().begin, name), syntax_message(error.description()));
    }
}

/// Byte offset of a column; columns count letters (code points) from 1.
std::size_t byte_of_column(std::string_view line, int column) {
    std::size_t byte = 0;
    for (int at = 1; at < column && byte < line.size(); ++at) {
        ++byte;
        const auto continues = [](char c) { return (static_cast<unsigned char>(c) >> 6U) == 2U; };
        while (byte < line.size() && continues(line[byte])) ++byte;
    }
    return byte;
}

/// "stage[2]" -> "stage", 2; "cells" -> "cells", no index.
struct Step {
    std::string_view key;
    std::optional<std::size_t> index;
};

/// Takes the first step off a path. Nothing if the path is malformed.
std::optional<Step> take_step(std::string_view& path) {
    const auto dot = path.find('.');
    std::string_view part = path.substr(0, dot);
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
    if (dot != std::string_view::npos && path.empty()) return std::nullopt;
    Step step{part, std::nullopt};
    if (const auto bracket = part.find('['); bracket != std::string_view::npos) {
        step.key = part.substr(0, bracket);
        std::size_t index = 0;
        const char* const end = part.data() + part.size();
        const auto read = std::from_chars(part.data() + bracket + 1, end, index);
        if (read.ec != std::errc{} || read.ptr + 1 != end || *read.ptr != ']') return std::nullopt;
        step.index = index;
    }
    if (step.key.empty()) return std::nullopt;
    return step;
}

/// The override's value: a TOML value if it is one, else bare text.
Value value_of_override(const std::string& text, const Loc& loc) {
    Value value;
    try {
        Document parsed = parse_document("value = " + text, loc.file);
        if (parsed.root.entries.size() == 1) value = std::move(parsed.root.entries[0].value);
    } catch (const Error&) {
        // not TOML: the bare text below
    }
    if (value.is_table() && value.entries.empty()) {
        value.kind = Value::Kind::text;
        value.text = text;
    }
    const auto settle = [&](auto&& self, Value& v) -> void {
        v.loc = loc;
        v.end_column = 0;
        for (Value& item : v.items) self(self, item);
        for (Value::Entry& entry : v.entries) {
            entry.loc = loc;
            self(self, entry.value);
        }
    };
    settle(settle, value);
    return value;
}

}  // namespace

bool Value::is_list_of_tables() const {
    return kind == Kind::list && !items.empty() &&
           std::all_of(items.begin(), items.end(), [](const Value& v) { return v.is_table(); });
}

const Value* Value::find(std::string_view key) const {
    for (const Entry& entry : entries)
        if (entry.key == key) return &entry.value;
    return nullptr;
}

Value* Value::find(std::string_view key) {
    return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
}

const Value* Document::find(std::string_view path) const {
    const Value* value = &root;
    while (value != nullptr && !path.empty()) {
        const std::optional<Step> step = take_step(path);
        SPHEROSCOPE_ASSERT(step.has_value(), std::string(path));
        value = value->find(step->key);
        if (value != nullptr && step->index)
            value = *step->index < value->items.size() ? &value->items[*step->index] : nullptr;
    }
    return value;
}

Loc Document::loc_of(std::string_view path) const {
    const auto dot = path.rfind('.');
    const std::string_view table =
        dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
    const std::string_view key = dot == std::string_view::npos ? path : path.substr(dot + 1);
    const Value* parent = find(table);
    if (parent == nullptr) return {name, 0, 0};
    for (const Value::Entry& entry : parent->entries)
        if (entry.key == key) return entry.value.is_table() ? entry.value.loc : entry.loc;
    const Value* item = find(path);
    return item == nullptr ? Loc{name, 0, 0} : item->loc;
}

std::string Document::as_written(const Value& value) const {
    const Loc& loc = value.loc;
    if (value.kind == Value::Kind::table) return "a table";
    if (loc.line > 0 && loc.line <= static_cast<int>(lines.size()) && value.end_column > 0) {
        const std::string& line = lines[static_cast<std::size_t>(loc.line) - 1];
        const std::size_t begin = byte_of_column(line, loc.column);
        return line.substr(begin, byte_of_column(line, value.end_column) - begin);
    }
    switch (value.kind) {
    case Value::Kind::text: return fmt::format("\"{}\"", value.text);
    case Value::Kind::integer: return fmt::format("{}", value.integer);
    case Value::Kind::number: return fmt::format("{}", value.number);
    case Value::Kind::boolean: return value.boolean ? "true" : "false";
    case Value::Kind::list: return "a list";
    default: return "a date or a time";
    }
}

std::string Document::quote(const Loc& loc, int end_column, const std::string& note) const {
    if (loc.line < 1 || loc.line > static_cast<int>(lines.size()))
        return note.empty() ? "" : "\n  " + note;
    const std::string number = fmt::format("{:5}", loc.line);
    const int width = std::max(1, end_column - loc.column);
    std::string text = fmt::format("\n{} | {}\n{:5} | {:{}}^{:~<{}}", number,
                                   lines[static_cast<std::size_t>(loc.line) - 1], "", "",
                                   loc.column - 1, "", width - 1);
    if (!note.empty()) text += "   " + note;
    return text;
}

Document parse_document(const std::string& text, const std::string& name) {
    Document document;
    document.name = name;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (line.ends_with('\r')) line.pop_back();
        // a tab is one column to the parser and must be one column under the caret
        std::replace(line.begin(), line.end(), '\t', ' ');
        document.lines.push_back(std::move(line));
    }
    document.root = value_from(parse_toml(text, name), name);
    return document;
}

void apply_override(Document& document, const Override& override_) {
    const Loc loc{"--set " + override_.key + "=" + override_.value, 0, 0};
    Value* value = &document.root;
    std::string_view rest = override_.key;
    std::string walked;
    do {
        const std::optional<Step> step = take_step(rest);
        if (!step)
            throw Error(loc, fmt::format("'{}' is not a key", override_.key),
                        "a key looks like cells.nodes or stage[2].cap");
        if (!value->is_table())
            throw Error(loc, fmt::format("{} is a value in the scene, not a table", walked));
        walked += fmt::format("{}{}", walked.empty() ? "" : ".", step->key);
        Value* next = value->find(step->key);
        if (step->index) {
            if (next == nullptr && *step->index == 0 && !rest.empty()) {
                // the first of [[picture]], say, in a scene that has none
                Value::Entry entry{std::string(step->key), loc, {}};
                entry.value.loc = loc;
                entry.value.kind = Value::Kind::list;
                entry.value.items.emplace_back().loc = loc;
                value->entries.push_back(std::move(entry));
                next = &value->entries.back().value;
            }
            const std::size_t n_items = next == nullptr ? 0 : next->items.size();
            if (*step->index >= n_items)
                throw Error(loc, fmt::format("there is no {}[{}]: the scene has {} of them{}",
                                             walked, *step->index, n_items,
                                             n_items > 0 ? ", counted from 0" : ""));
            next = &next->items[*step->index];
            walked += fmt::format("[{}]", *step->index);
        } else if (next == nullptr) {
            Value::Entry entry{std::string(step->key), loc, {}};
            entry.value.loc = loc;
            value->entries.push_back(std::move(entry));
            next = &value->entries.back().value;
        }
        value = next;
    } while (!rest.empty());
    *value = value_of_override(override_.value, loc);
}

}  // namespace spheroscope::scene
