#include "engine/scene/key_text.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/value_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

bool is_written(const Key& key) {
    return key.absent.rule != WhenAbsent::Rule::input_of &&
           key.absent.rule != WhenAbsent::Rule::optional_input;
}

/// A value that follows from several others may be one that no file may say.
void check_size(Draft& draft, const Key& key, std::size_t item) {
    const auto* reach = std::get_if<Reach<double>>(&key.access);
    const double value = reach != nullptr ? (*reach)(draft, item) : 0.0;
    if (reach == nullptr || !std::isfinite(value)) return;
    const std::string sizes = missed_sizes(key, value);
    if (!sizes.empty())
        throw Error(draft.document->loc_of(key.table),
                    fmt::format("{}.{} must be {}, got {} from other keys", key.table, key.name,
                                sizes, fmt::format("{:g} {}", value, engine_unit(key.dimension))),
                    key.absent.rule == WhenAbsent::Rule::computed
                        ? fmt::format("it is {}", key.absent.words)
                        : fmt::format("it follows from {}", key.absent.words));
}

void write_keys(Draft& draft, const Table& table, std::size_t item, std::string& text) {
    for (const Key& key : all_keys()) {
        if (key.table != table.path || !is_written(key)) continue;
        if (key.applies.holds != nullptr && !key.applies.holds(draft, item)) continue;
        check_size(draft, key, item);
        const std::string value = value_text(draft, key, item);
        if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
    }
}

/// Number of tables of this row in the draft.
std::size_t count_of(const Draft& draft, const Table& table) {
    using Presence = Table::Presence;
    switch (table.presence) {
    case Presence::list:
        if (table.path == "stage") return draft.scene.stages.size();
        if (table.path == "picture") return draft.scene.pictures.size();
        SPHEROSCOPE_ASSERT(table.path == "variant", "every list of tables is counted here");
        return draft.scene.variants.size();
    case Presence::named:
        if (table.path == "expect") return draft.scene.expect.size();
        SPHEROSCOPE_ASSERT(table.path == "stability", "every named table is counted here");
        return draft.scene.stability.size();
    case Presence::part: return draft.given(table.path) ? 1 : 0;
    default: return table.applies.holds == nullptr || table.applies.holds(draft, 0) ? 1 : 0;
    }
}

std::string name_of(const Draft& draft, const Table& table, std::size_t item) {
    return table.path == "expect" ? draft.scene.expect[item].measure
                                  : draft.scene.stability[item].methods;
}

}  // namespace

std::string canonical_text(Draft& draft) {
    std::string text;
    for (const Table& table : all_tables()) {
        const std::size_t count = count_of(draft, table);
        for (std::size_t item = 0; item < count; ++item) {
            if (!text.empty()) text += "\n";
            if (table.presence == Table::Presence::list)
                text += fmt::format("[[{}]]\n", table.path);
            else if (table.presence == Table::Presence::named)
                text +=
                    fmt::format("[{}.{}]\n", table.path, toml_string(name_of(draft, table, item)));
            else
                text += fmt::format("[{}]\n", table.path);
            write_keys(draft, table, item, text);
        }
    }
    return text;
}

}  // namespace spheroscope::scene
