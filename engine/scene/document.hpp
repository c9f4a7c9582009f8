#pragma once

#include "engine/base/error.hpp"
#include "engine/scene/scene.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// A scene file as a tree in which everything knows its place. toml++ is seen by document.cpp alone:
// its headers cost seconds of compile time.
namespace spheroscope::scene {

/// One value of a scene file or of an override.
struct Value {
    enum class Kind { text, integer, number, boolean, list, table, other };

    struct Entry;  // a key and its value

    Kind kind = Kind::table;
    Loc loc;  ///< of the value; of its header for a table. An override: file is "--set key=value"
    int end_column = 0;  ///< one past the value's last letter, on the same line; 0: not known
    std::string text;    ///< text
    std::int64_t integer = 0;
    double number = 0.0;
    bool boolean = false;
    std::vector<Value> items;    ///< list
    std::vector<Entry> entries;  ///< table; in the order of the file

    [[nodiscard]] bool is_table() const { return kind == Kind::table; }
    /// A list whose items are all tables: [[stage]].
    [[nodiscard]] bool is_list_of_tables() const;
    /// The value of a key of this table, nullptr if there is none.
    [[nodiscard]] const Value* find(std::string_view key) const;
    [[nodiscard]] Value* find(std::string_view key);
};

struct Value::Entry {
    std::string key;
    Loc loc;
    Value value;
};

/// A scene file in memory.
struct Document {
    std::string name;                ///< stands for the file in messages
    std::vector<std::string> lines;  ///< as written, for quoting
    Value root;

    /// The value at a path such as "contact.adhesion.omega" or "stage[2].cap"; nullptr if absent.
    [[nodiscard]] const Value* find(std::string_view path) const;
    /// The place of the key at a path (for a table: of its header); {name, 0, 0} if absent.
    [[nodiscard]] Loc loc_of(std::string_view path) const;
    /// The value as the user wrote it, or "a table", "a list" where that would not fit on a line.
    [[nodiscard]] std::string as_written(const Value& value) const;
    /// The line of `loc` with ^~~~ under the columns [loc.column, end_column) and `note` behind it,
    /// starting with a newline. Without a line to quote (an override): the note alone.
    [[nodiscard]] std::string quote(const Loc& loc, int end_column, const std::string& note) const;
};

/// Throws Error with file:line:column when the text is not TOML 1.0, for example for a key given
/// twice.
[[nodiscard]] Document parse_document(const std::string& text, const std::string& name);

/// Puts one override into the tree, making tables on its way. The value is read as a TOML value if
/// it is one, else as bare text. Of a list that is not there, item 0 is made ("picture[0].field").
/// Throws Error when the path leads through a value or beyond a list.
void apply_override(Document& document, const Override& override_);

}  // namespace spheroscope::scene
