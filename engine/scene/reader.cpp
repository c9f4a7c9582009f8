#include "engine/scene/reader.hpp"

#include "engine/base/nearest_word.hpp"
#include "engine/scene/value_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace spheroscope::scene {
namespace {

std::string joined(std::string_view table, std::string_view name) {
    return table.empty() ? std::string(name) : fmt::format("{}.{}", table, name);
}

std::string_view last_step(std::string_view path) {
    const auto dot = path.rfind('.');
    return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

const Table* find_table(std::string_view path) {
    for (const Table& table : all_tables())
        if (table.path == path) return &table;
    return nullptr;
}

/// Whether the path is a table of the table of tables, or leads to one ("load").
bool leads_to_table(std::string_view path) {
    return std::any_of(all_tables().begin(), all_tables().end(), [&](const Table& table) {
        return table.path.starts_with(path) &&
               (table.path.size() == path.size() || table.path[path.size()] == '.');
    });
}

// ---- unknown names -----------------------------------------------------------------------------

/// Names that may stand in a table, whose name is a path.
std::vector<std::string> names_in(std::string_view path) {
    std::vector<std::string> names;
    for (const Key& key : all_keys())
        if (key.table == path) names.emplace_back(key.name);
    const std::string prefix = path.empty() ? "" : std::string(path) + ".";
    for (const Table& table : all_tables()) {
        if (!table.path.starts_with(prefix)) continue;
        const std::string_view rest = table.path.substr(prefix.size());
        if (!rest.empty()) names.emplace_back(rest.substr(0, rest.find('.')));
    }
    return names;
}

/// The only table that has a key of this name, else empty.
std::string_view only_home_of(std::string_view name) {
    std::string_view home;
    for (const Key& key : all_keys()) {
        if (key.name != name) continue;
        if (!home.empty()) return {};
        home = key.table;
    }
    return home;
}

[[noreturn]] void refuse_unknown(const Value::Entry& entry, std::string_view path) {
    const std::string nearest = nearest_word(entry.key, names_in(path));
    if (entry.value.is_table() || entry.value.is_list_of_tables()) {
        const bool is_list = entry.value.is_list_of_tables();
        const auto bracketed = [&](std::string_view name) {
            return fmt::format(fmt::runtime(is_list ? "[[{}]]" : "[{}]"), joined(path, name));
        };
        std::string message = "unknown table " + bracketed(entry.key);
        if (!nearest.empty()) message += fmt::format("; did you mean {}?", bracketed(nearest));
        throw Error(entry.value.is_table() ? entry.value.loc : entry.loc, message);
    }
    std::string message = fmt::format("unknown key '{}' {}", entry.key,
                                      path.empty() ? std::string("outside of any table")
                                                   : fmt::format("in [{}]", path));
    if (const std::string_view home = only_home_of(entry.key); !home.empty())
        message += fmt::format("; it belongs in [{}]", home);
    else if (!nearest.empty())
        message += fmt::format("; did you mean '{}'?", nearest);
    throw Error(entry.loc, message);
}

/// Looks for unknown names in the order of the file. `path` is that of the table in the tables'
/// table: without indices, and "expect" for each of the named tables in it.
void check_names(const Value& value, const std::string& path) {
    for (const Value::Entry& entry : value.entries) {
        const std::string inner = joined(path, entry.key);
        if (entry.value.is_table() && leads_to_table(inner)) {
            const Table* table = find_table(inner);
            if (table != nullptr && table->presence == Table::Presence::named) {
                for (const Value::Entry& named : entry.value.entries)
                    if (named.value.is_table()) check_names(named.value, inner);
            } else {
                check_names(entry.value, inner);
            }
        } else if (entry.value.is_list_of_tables() && find_table(inner) != nullptr) {
            for (const Value& item : entry.value.items) check_names(item, inner);
        } else if (find_key(path, entry.key) == nullptr && find_table(inner) == nullptr) {
            if (leads_to_table(inner))
                throw Error(entry.loc, fmt::format("[{}] holds tables only: [{}.{}]", inner, inner,
                                                   names_in(inner).front()));
            refuse_unknown(entry, path);
        }
    }
}

// ---- reading -----------------------------------------------------------------------------------

/// Checks that exactly one of the keys of a group stands in the table.
void check_group(const Draft& draft, const Value& table, const Key& key, const std::string& path) {
    std::vector<std::string> wanted, got;
    for (const Key& other : all_keys()) {
        if (other.table != key.table || other.absent.words != key.absent.words) continue;
        wanted.emplace_back(other.name);
        if (table.find(other.name) != nullptr) got.emplace_back(other.name);
    }
    if (got.size() == 1) return;
    const Loc loc = got.empty() ? draft.document->loc_of(path)
                                : draft.document->loc_of(joined(path, got.back()));
    const std::string which =
        got.empty() ? "none of them" : fmt::format("{}", fmt::join(got, " and "));
    throw Error(loc, fmt::format("[{}] wants exactly one of {}, got {}", path,
                                 fmt::join(wanted, ", "), which));
}

void read_key(Draft& draft, const Value& table, const Key& key, const std::string& path,
              std::size_t item) {
    const std::string key_path = joined(path, key.name);
    const Value* value = table.find(key.name);
    // [cells.radius] is a table of its own beside the key cells.radius
    if (value != nullptr && value->is_table() && find_table(key_path) != nullptr) value = nullptr;
    if (key.absent.rule == WhenAbsent::Rule::one_of) check_group(draft, table, key, path);
    const bool applies = key.applies.holds == nullptr || key.applies.holds(draft, item);
    if (value == nullptr) {
        if (applies && key.absent.rule == WhenAbsent::Rule::required)
            throw Error(table.loc.line > 0 ? table.loc : Loc{draft.document->name, 0, 0},
                        fmt::format("{} is missing; it is required{}{}", key_path,
                                    key.applies.words.empty() ? "" : " ", key.applies.words),
                        key.typical.empty() ? "" : fmt::format("typical: {}", key.typical));
        return;
    }
    if (!applies) {
        const auto entry = std::find_if(table.entries.begin(), table.entries.end(),
                                        [&](const auto& e) { return e.key == key.name; });
        throw Error(entry->loc, fmt::format("{} does not apply here: it belongs {}", key_path,
                                            key.applies.words));
    }
    read_value(draft, key, *value, key_path, item);
}

void read_keys(Draft& draft, const Table& table, const Value& value, const std::string& path,
               std::size_t item) {
    for (const Key& key : all_keys())
        if (key.table == table.path) read_key(draft, value, key, path, item);
}

[[noreturn]] void refuse_shape(const Document& document, const std::string& wanted,
                               const Value& value) {
    throw Error(value.loc, fmt::format("{}, got {}{}", wanted, document.as_written(value),
                                       document.quote(value.loc, value.end_column, "")));
}

void read_list(Draft& draft, const Table& table, const Value& value) {
    if (!value.is_list_of_tables())
        refuse_shape(*draft.document,
                     fmt::format("{0} is a list of tables, each with a header [[{0}]]", table.path),
                     value);
    for (std::size_t item = 0; item < value.items.size(); ++item) {
        table.enter(draft, value.items[item].loc, "");
        read_keys(draft, table, value.items[item], fmt::format("{}[{}]", table.path, item), item);
    }
}

void read_named(Draft& draft, const Table& table, const Value& value) {
    if (!value.is_table())
        refuse_shape(*draft.document, fmt::format("[{}] is a table", table.path), value);
    std::size_t item = 0;
    for (const Value::Entry& entry : value.entries) {
        const std::string path = joined(table.path, entry.key);
        if (!entry.value.is_table())
            refuse_shape(*draft.document, fmt::format("{} wants a table of bounds", path),
                         entry.value);
        table.enter(draft, entry.loc, entry.key);
        read_keys(draft, table, entry.value, path, item++);
    }
}

void read_table(Draft& draft, const Table& table) {
    const std::string path(table.path);
    const Value* value = draft.document->find(path);
    using Presence = Table::Presence;
    if (table.presence == Presence::list) {
        if (value != nullptr) read_list(draft, table, *value);
        return;
    }
    if (table.presence == Presence::named) {
        if (value != nullptr) read_named(draft, table, *value);
        return;
    }
    if (value != nullptr && !value->is_table()) {
        if (find_key(path.substr(0, path.find('.')), last_step(path)) != nullptr) return;
        refuse_shape(*draft.document, fmt::format("[{}] is a table", path), *value);
    }
    if (value == nullptr) {
        if (table.presence == Presence::required)
            throw Error(Loc{draft.document->name, 0, 0},
                        fmt::format("the table [{}] is missing", path));
        // parents that exist through their parts alone (contact, by [contact.adhesion]) are found
        // above
        if (table.presence == Presence::part) return;
    }
    const bool applies = table.applies.holds == nullptr || table.applies.holds(draft, 0);
    if (!applies) {
        if (value == nullptr) return;
        throw Error(value->loc, fmt::format("[{}] does not apply here: it belongs {}", path,
                                            table.applies.words));
    }
    const Value nothing;
    if (value != nullptr && table.enter != nullptr) table.enter(draft, value->loc, "");
    read_keys(draft, table, value != nullptr ? *value : nothing, path, 0);
}

}  // namespace

Draft read_draft(const Document& document) {
    Draft draft;
    draft.document = &document;
    draft.scene.file = document.name;
    check_names(document.root, "");
    for (const Table& table : all_tables()) read_table(draft, table);
    return draft;
}

void drop_alternatives(Document& document, const Override& override_) {
    const auto dot = override_.key.rfind('.');
    if (dot == std::string::npos) return;
    const std::string table = override_.key.substr(0, dot);
    const std::string name = override_.key.substr(dot + 1);
    const Key* key = find_key(table, name);
    using Rule = WhenAbsent::Rule;
    if (key == nullptr || (key->absent.rule != Rule::one_of && key->absent.rule != Rule::input_of))
        return;
    Value* parent = &document.root;
    for (std::string_view rest = table; parent != nullptr && !rest.empty();) {
        const auto end = std::min(rest.find('.'), rest.size());
        parent = parent->find(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (parent == nullptr) return;
    std::erase_if(parent->entries, [&](const Value::Entry& entry) {
        const Key* other = find_key(table, entry.key);
        return other != nullptr && entry.key != name && entry.loc.line > 0 &&
               other->absent.words == key->absent.words;
    });
}

}  // namespace spheroscope::scene
