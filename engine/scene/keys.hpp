#pragma once

#include "engine/scene/document.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/units.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <variant>

// The table of all keys of a scene file. Reading, the canonical text, the documentation and the
// messages loop over it: a new key is one row in keys.cpp and one member in scene.hpp.
namespace spheroscope::scene {

/// A scene on its way from text to values: the scene itself and inputs that are resolved into it.
struct Draft {
    const Document* document = nullptr;
    Scene scene;
    std::optional<double> Et_over_omega, gamma_over_omega;
    int equilibrium_overlap = 2;  ///< of W: delta_eq / h0
    struct ExpectedValue {
        std::optional<double> value, tolerance, relative;
    };
    std::vector<ExpectedValue> expected_values;  ///< one for each of scene.expect

    /// Whether the file or an override has this table or key.
    [[nodiscard]] bool given(std::string_view path) const {
        return document->find(path) != nullptr;
    }
};

/// A member behind an enumeration: read and written as one of `words`.
struct Choice {
    std::span<const std::string_view> words;
    int (*get)(Draft&, std::size_t item);
    void (*set)(Draft&, std::size_t item, int word);
};

/// How to reach the member of a key; `item` counts the tables of a list of tables.
template <class T> using Reach = T& (*)(Draft&, std::size_t item);
using CentreRows = std::vector<std::array<double, 4>>;
using Access =
    std::variant<Reach<double>, Reach<int>, Reach<std::uint64_t>, Reach<bool>, Reach<std::string>,
                 Reach<std::vector<std::string>>, Reach<CentreRows>, Reach<std::array<double, 3>>,
                 Reach<std::array<double, 2>>, Reach<std::array<int, 2>>, Choice>;

/// What a number must fulfil, and how to say it: "> 0".
struct Bound {
    bool (*holds)(double) = nullptr;  ///< nullptr: any finite number
    std::string_view words;
};

/// When a key (or a table) has a meaning, and how to say it: 'with arrangement = "pair"'.
struct Applies {
    bool (*holds)(const Draft&, std::size_t item) = nullptr;  ///< nullptr: always
    std::string_view words;
};

/// What it means when a key is absent from a table that is there.
struct WhenAbsent {
    enum class Rule {
        standard,  ///< the member's own initial value
        required,
        computed,        ///< resolved from other values, as `words` says
        one_of,          ///< exactly one of the keys of `words` must be there
        input_of,        ///< as one_of, but resolved into another key, so not written
        optional_input,  ///< resolved into another key, so not written
    };
    Rule rule = Rule::standard;
    std::string_view words;
};

struct Key {
    std::string_view table, name;
    Access access;
    Dimension dimension = Dimension::number;
    Bound bound;
    WhenAbsent absent;
    Applies applies;
    std::string_view typical, source, description;
    std::span<const std::string_view> words{};  ///< text that must be one of these
};

struct Table {
    enum class Presence {
        required,
        standard,  ///< if absent, every key has its default
        part,      ///< a part of the run: if absent, nothing of it is there
        list,      ///< [[stage]]: any number, in order
        named,     ///< [expect.NAME]: any number, the names are free
    };
    std::string_view path;
    Presence presence;
    /// Makes the part and notes its place. `name` is that of a named table, else empty.
    void (*enter)(Draft&, const Loc&, const std::string& name);
    Applies applies;
    std::string_view description;
};

/// In the order of the canonical text; what decides whether a key applies stands before it.
[[nodiscard]] std::span<const Table> all_tables();
[[nodiscard]] std::span<const Key> all_keys();

/// nullptr if there is no such key in the table.
[[nodiscard]] const Key* find_key(std::string_view table, std::string_view name);
/// The same by its path, "cortex.tension.gamma".
[[nodiscard]] const Key* find_key(std::string_view path);

/// As in scene files: "two_sided".
[[nodiscard]] std::string_view word_of(OmegaReading reading);

/// "stiffness (kPa)", "one of "packing", "single"", "list of texts".
[[nodiscard]] std::string describe_type(const Key& key);

}  // namespace spheroscope::scene
