#include "engine/claims/claim_table.hpp"

#include "engine/scene/document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace spheroscope::claims {
namespace {

using scene::Document;
using scene::Value;

/// Reads the keys of one table of the file; each key that the file has must be asked for.
class TableReader {
  public:
    TableReader(const Document& document, const Value& table, std::string what)
        : document_(document), table_(table), what_(std::move(what)) {}

    [[nodiscard]] const Value* optional(const std::string& key) {
        known_.push_back(key);
        return table_.find(key);
    }

    [[nodiscard]] std::string text(const std::string& key) {
        const Value* value = optional(key);
        if (value == nullptr) throw Error(table_.loc, fmt::format("{} has no '{}'", what_, key));
        return text_of(*value, key);
    }

    [[nodiscard]] std::string text_or(const std::string& key, const std::string& standard) {
        const Value* value = optional(key);
        return value == nullptr ? standard : text_of(*value, key);
    }

    [[nodiscard]] std::optional<double> number(const std::string& key) {
        const Value* value = optional(key);
        if (value == nullptr) return std::nullopt;
        return number_of(*value, key);
    }

    /// A whole number from 100: fewer beads have no jamming point to speak of.
    [[nodiscard]] int count_or(const std::string& key, int standard) {
        const Value* value = optional(key);
        if (value == nullptr) return standard;
        if (value->kind != Value::Kind::integer || value->integer < 100 || value->integer > 100000)
            refuse(*value, key, "a whole number from 100 to 100000");
        return static_cast<int>(value->integer);
    }

    [[nodiscard]] std::vector<std::string> texts(const std::string& key) {
        std::vector<std::string> texts;
        for (const Value& item : list(key)) texts.push_back(text_of(item, key));
        return texts;
    }

    [[nodiscard]] std::vector<std::uint64_t> seeds(const std::string& key) {
        std::vector<std::uint64_t> seeds;
        for (const Value& item : list(key)) {
            if (item.kind != Value::Kind::integer || item.integer < 0)
                refuse(item, key, "a list of whole numbers from 0");
            seeds.push_back(static_cast<std::uint64_t>(item.integer));
        }
        std::vector<std::uint64_t> sorted = seeds;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            refuse(*table_.find(key), key, "each seed once");
        return seeds;
    }

    [[nodiscard]] double number_of(const Value& value, const std::string& key) const {
        if (value.kind == Value::Kind::integer) return static_cast<double>(value.integer);
        if (value.kind != Value::Kind::number || !std::isfinite(value.number))
            refuse(value, key, "a number");
        return value.number;
    }

    /// Throws unless all keys of the file are known here.
    void finish() const {
        for (const Value::Entry& entry : table_.entries)
            if (std::find(known_.begin(), known_.end(), entry.key) == known_.end())
                throw Error(entry.loc, fmt::format("{} has no key '{}'", what_, entry.key),
                            fmt::format("keys are {}", fmt::join(known_, ", ")));
    }

    [[noreturn]] void refuse(const Value& value, const std::string& key,
                             const std::string& wanted) const {
        throw Error(value.loc,
                    fmt::format("'{}' wants {}, got {}", key, wanted, document_.as_written(value)));
    }

    [[nodiscard]] std::string text_of(const Value& value, const std::string& key) const {
        if (value.kind != Value::Kind::text || value.text.empty()) refuse(value, key, "a text");
        return value.text;
    }

  private:
    [[nodiscard]] std::vector<Value> list(const std::string& key) {
        const Value* value = optional(key);
        if (value == nullptr) return {};
        if (value->kind != Value::Kind::list) refuse(*value, key, "a list");
        return value->items;
    }

    const Document& document_;
    const Value& table_;
    std::string what_;
    std::vector<std::string> known_;
};

std::vector<Value> tables(const Document& document, const std::string& name) {
    const Value* value = document.root.find(name);
    if (value == nullptr) return {};
    if (!value->is_list_of_tables())
        throw Error(value->loc, fmt::format("'{0}' wants tables: [[{0}]]", name));
    return value->items;
}

ClaimedSetup read_setup(const Document& document, const Value& table) {
    TableReader reader(document, table, "a setup");
    ClaimedSetup setup;
    setup.loc = table.loc;
    setup.name = reader.text("name");
    setup.scene = reader.text_or("scene", "");
    setup.beads = reader.count_or("beads", 0);
    setup.settings = reader.texts("set");
    setup.seeds = reader.seeds("seeds");
    setup.quick_seeds = reader.seeds("quick_seeds");
    reader.finish();
    if (setup.scene.empty() == (setup.beads == 0))
        throw Error(table.loc, fmt::format("setup '{}' wants either a scene or a number of beads",
                                           setup.name));
    if (setup.beads > 0 && !setup.settings.empty())
        throw Error(table.loc,
                    fmt::format("setup '{}' is of beads: there is nothing to set", setup.name));
    if (setup.seeds.empty())
        throw Error(table.loc, fmt::format("setup '{}' has no seeds", setup.name),
                    "seeds = [1, 2, 3, 4, 5]");
    return setup;
}

Range read_range(TableReader& reader, const Value& table) {
    Range range;
    int n = 0;
    if (const auto is = reader.number("is")) {
        range = {*is, *is};
        ++n;
    }
    if (const auto above = reader.number("above")) {
        range.min = *above;
        ++n;
    }
    if (const auto below = reader.number("below")) {
        range.max = *below;
        ++n;
    }
    if (const Value* between = reader.optional("between")) {
        if (between->kind != Value::Kind::list || between->items.size() != 2)
            reader.refuse(*between, "between", "two numbers");
        range = {reader.number_of(between->items[0], "between"),
                 reader.number_of(between->items[1], "between")};
        if (range.min > range.max) reader.refuse(*between, "between", "the smaller number first");
        ++n;
    }
    if (n != 1)
        throw Error(table.loc,
                    fmt::format("a claim wants one of is, above, below, between; got {}", n));
    return range;
}

/// { setup = "case_b", number = "energy" }; what is left out is that of the claim.
std::optional<Quantity> read_other(const Document& document, TableReader& reader,
                                   const std::string& key, const Quantity& measured) {
    const Value* table = reader.optional(key);
    if (table == nullptr) return std::nullopt;
    if (!table->is_table()) reader.refuse(*table, key, "{ setup = ..., number = ... }");
    TableReader other(document, *table, "'" + key + "'");
    Quantity quantity{table->loc, other.text_or("setup", measured.setup),
                      other.text_or("number", measured.number)};
    other.finish();
    if (quantity.setup == measured.setup && quantity.number == measured.number)
        throw Error(table->loc, fmt::format("'{}' is the measured number itself", key));
    return quantity;
}

Written read_written(TableReader& reader) {
    const Value* const value = reader.optional("written");
    if (value == nullptr) return Written::before;
    for (const Written written : {Written::before, Written::after})
        if (value->kind == Value::Kind::text && value->text == name_of(written)) return written;
    reader.refuse(*value, "written", "\"before\" or \"after\" (the runs)");
}

Claim read_claim(const Document& document, const Value& table, const std::string& setup,
                 bool is_one_of_several) {
    TableReader reader(document, table, "a claim");
    Claim claim;
    claim.loc = table.loc;
    claim.id = reader.text("id") + (is_one_of_several ? "/" + setup : "");
    claim.source = reader.text("source");
    claim.says = reader.text("says");
    claim.written = read_written(reader);
    claim.unit = reader.text_or("unit", "");
    static_cast<void>(reader.optional("setup"));
    claim.measured = {table.loc, setup, reader.text("number")};
    claim.minus = read_other(document, reader, "minus", claim.measured);
    claim.over = read_other(document, reader, "over", claim.measured);
    claim.factor = reader.number("factor").value_or(1.0);
    claim.paper = read_range(reader, table);
    claim.tolerance = reader.number("tolerance").value_or(0.0);
    claim.tolerance_factor = reader.number("tolerance_factor").value_or(1.0);
    claim.undecidable = reader.text_or("undecidable", "");
    claim.remark = reader.text_or("remark", "");
    reader.finish();
    if (claim.minus && claim.over)
        throw Error(table.loc, "a claim wants one of minus, over; got both");
    if (claim.tolerance < 0.0)
        throw Error(table.find("tolerance")->loc, "'tolerance' wants a number from 0");
    if (const Value* factor = table.find("tolerance_factor")) {
        if (claim.tolerance_factor < 1.0)
            throw Error(factor->loc, "'tolerance_factor' wants a number from 1");
        if (table.find("tolerance") != nullptr)
            throw Error(factor->loc, "a claim wants one of tolerance, tolerance_factor; got both");
        if (claim.paper.min * claim.paper.max <= 0.0 || claim.paper.is_one_sided())
            throw Error(factor->loc,
                        "'tolerance_factor' wants a range on one side of zero, with both ends");
    }
    return claim;
}

/// The setup, or the list of setups, of one table.
std::vector<std::string> setups_of(const Document& document, const Value& table) {
    TableReader reader(document, table, "a claim");
    const Value* setup = table.find("setup");
    if (setup != nullptr && setup->kind == Value::Kind::list) {
        if (setup->items.empty()) reader.refuse(*setup, "setup", "a setup or a list of them");
        return reader.texts("setup");
    }
    return {reader.text("setup")};
}

void check_names(const ClaimTable& table) {
    std::vector<std::string> names;
    for (const ClaimedSetup& setup : table.setups) {
        if (std::find(names.begin(), names.end(), setup.name) != names.end())
            throw Error(setup.loc, fmt::format("there are two setups '{}'", setup.name));
        names.push_back(setup.name);
    }
    const auto check = [&](const Quantity& quantity) {
        if (table.find_setup(quantity.setup) == nullptr)
            throw Error(quantity.loc, fmt::format("there is no setup '{}'", quantity.setup),
                        "setups are " + fmt::format("{}", fmt::join(names, ", ")));
    };
    std::vector<std::string> ids;
    int n_undecidable = 0;
    for (const Claim& claim : table.claims) {
        if (std::find(ids.begin(), ids.end(), claim.id) != ids.end())
            throw Error(claim.loc, fmt::format("there are two claims '{}'", claim.id));
        ids.push_back(claim.id);
        check(claim.measured);
        if (claim.minus) check(*claim.minus);
        if (claim.over) check(*claim.over);
        if (!claim.undecidable.empty() && ++n_undecidable > k_most_undecidable)
            throw Error(claim.loc,
                        fmt::format("more than {} claims are undecidable", k_most_undecidable));
    }
}

}  // namespace

std::string_view name_of(Written written) {
    return written == Written::before ? "before" : "after";
}

bool Range::is_one_sided() const { return std::isinf(min) || std::isinf(max); }

double Range::distance(double value) const { return std::max({0.0, min - value, value - max}); }

std::string Range::text() const {
    if (std::isinf(max)) return fmt::format("> {:.4g}", min);
    if (std::isinf(min)) return fmt::format("< {:.4g}", max);
    return min == max ? fmt::format("{:.4g}", min) : fmt::format("{:.4g} ... {:.4g}", min, max);
}

Range Claim::accepted() const {
    if (tolerance_factor == 1.0) return {paper.min - tolerance, paper.max + tolerance};
    const double f = tolerance_factor;
    return paper.min > 0.0 ? Range{paper.min / f, paper.max * f}
                           : Range{paper.min * f, paper.max / f};
}

std::string Claim::tolerance_text() const {
    if (tolerance_factor != 1.0) return fmt::format("factor {:.4g}", tolerance_factor);
    return tolerance == 0.0 ? "" : fmt::format("{:.4g}", tolerance);
}

std::vector<std::string> Claim::setups() const {
    std::vector<std::string> names{measured.setup};
    const auto& other = minus ? minus : over;
    if (other && other->setup != measured.setup) names.push_back(other->setup);
    return names;
}

const ClaimedSetup* ClaimTable::find_setup(const std::string& name) const {
    const auto at = std::find_if(setups.begin(), setups.end(),
                                 [&](const ClaimedSetup& setup) { return setup.name == name; });
    return at == setups.end() ? nullptr : &*at;
}

std::string ClaimTable::scene_path(const ClaimedSetup& setup) const {
    return (std::filesystem::path(file).parent_path() / setup.scene).lexically_normal().string();
}

ClaimTable parse_claims(const std::string& text, const std::string& name) {
    const Document document = scene::parse_document(text, name);
    for (const Value::Entry& entry : document.root.entries)
        if (entry.key != "setup" && entry.key != "claim")
            throw Error(document.loc_of(entry.key),
                        fmt::format("a file of claims has no '{}'", entry.key),
                        "it has [[setup]] and [[claim]]");
    ClaimTable table;
    table.file = name;
    for (const Value& setup : tables(document, "setup"))
        table.setups.push_back(read_setup(document, setup));
    for (const Value& claim : tables(document, "claim")) {
        const std::vector<std::string> setups = setups_of(document, claim);
        for (const std::string& setup : setups)
            table.claims.push_back(read_claim(document, claim, setup, setups.size() > 1));
    }
    if (table.claims.empty()) throw Error(Loc{name, 0, 0}, "there is no [[claim]] in it");
    check_names(table);
    return table;
}

ClaimTable load_claims(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw Error(path + ": cannot be read", "scenes/paper/paper.claims is the paper's");
    std::ostringstream text;
    text << file.rdbuf();
    return parse_claims(text.str(), path);
}

}  // namespace spheroscope::claims
