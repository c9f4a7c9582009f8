#include "engine/reports/report_table.hpp"

#include "engine/base/csv_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::reports {
namespace {

/// `digits` 0: as many as it takes to read the same bits again.
std::string text_of(const TableCell& cell, int digits) {
    struct Visitor {
        int digits;
        std::string operator()(const Missing& missing) const { return std::string(missing.word); }
        std::string operator()(double value) const {
            if (std::isnan(value)) return "-";
            return digits > 0 ? fmt::format("{:.{}g}", value, digits) : fmt::format("{}", value);
        }
        std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
        std::string operator()(bool value) const { return value ? "yes" : "no"; }
        std::string operator()(const std::string& value) const { return value; }
    };
    return std::visit(Visitor{digits}, cell);
}

}  // namespace

std::string ReportTable::aligned_text() const {
    constexpr int digits = 4;
    std::vector<std::size_t> widths(columns.size());
    std::vector<bool> is_text(columns.size(), false);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        widths[c] = columns[c].name.size();
        for (const auto& row : rows) {
            widths[c] = std::max(widths[c], text_of(row[c], digits).size());
            if (std::holds_alternative<std::string>(row[c])) is_text[c] = true;
        }
    }
    std::string text;
    const auto add = [&](auto&& cell) {
        std::string line;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (!columns[c].is_shown) continue;
            if (!line.empty()) line += "  ";
            const std::string word = cell(c);
            line += is_text[c] ? fmt::format("{:<{}}", word, widths[c])
                               : fmt::format("{:>{}}", word, widths[c]);
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    };
    add([&](std::size_t c) { return columns[c].name; });
    for (const auto& row : rows) add([&](std::size_t c) { return text_of(row[c], digits); });
    return text;
}

std::string ReportTable::csv_text(const std::vector<std::string>& comments) const {
    std::string text;
    for (const std::string& comment : comments) text += "# " + comment + "\n";
    for (std::size_t c = 0; c < columns.size(); ++c)
        text += (c == 0 ? "" : ",") + csv_word(columns[c].name);
    text += "\n";
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            text += (c == 0 ? "" : ",") + csv_word(text_of(row[c], 0));
        text += "\n";
    }
    return text;
}

}  // namespace spheroscope::reports
