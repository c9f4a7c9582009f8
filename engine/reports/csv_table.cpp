#include "engine/reports/csv_table.hpp"

#include "engine/base/counted.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace spheroscope::reports {
/// Fields of the record at `at`, which is moved behind it. Quotations may hold commas and line ends
/// (RFC 4180).
std::vector<CsvTable::Field> CsvTable::next_record(const std::string& text, std::size_t& at,
                                                   int& line, const std::string& path) {
    const int first_line = line;
    std::size_t line_start = at;
    std::vector<Field> fields{{"", line, 1}};
    bool is_quoted = false;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '\n') {
            ++line;
            line_start = at + 1;
        }
        if (c == '"') {
            const bool is_doubled = is_quoted && at + 1 < text.size() && text[at + 1] == '"';
            if (is_doubled)
                fields.back().text += text[++at];
            else
                is_quoted = !is_quoted;
        } else if (c == ',' && !is_quoted) {
            fields.push_back({"", line, static_cast<int>(at - line_start) + 2});
        } else if (c == '\n' && !is_quoted) {
            ++at;
            return fields;
        } else if (c != '\r' || is_quoted) {
            fields.back().text += c;
        }
    }
    if (is_quoted) throw Error(Loc{path, first_line, 1}, "a quotation has no end");
    return fields;
}

bool read_number(const std::string& text, double& value) {
    value = std::numeric_limits<double>::quiet_NaN();
    if (text == "-") return true;
    char* end = nullptr;
    const double read = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size()) return false;
    value = read;
    return true;
}

CsvTable::CsvTable(const std::string& path) : path_(path) {
    std::ifstream file(path);
    if (!file) throw Error(path + ": cannot be read");
    std::ostringstream content;
    content << file.rdbuf();
    const std::string text = content.str();
    std::size_t at = 0;
    int line = 1;
    while (at < text.size()) {
        if (text.compare(at, 2, "# ") == 0) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            comments_.push_back(text.substr(at + 2, end - at - 2));
            at = end + 1;
            ++line;
            continue;
        }
        const int line_of_row = line;
        std::vector<Field> fields = next_record(text, at, line, path);
        if (columns_.empty()) {
            for (Field& field : fields) columns_.push_back(std::move(field.text));
            continue;
        }
        if (fields.size() != columns_.size())
            throw Error(
                Loc{path, line_of_row, 1},
                fmt::format("wanted {}, got {}", counted(columns_.size(), "field"), fields.size()));
        rows_.push_back(std::move(fields));
    }
    if (columns_.empty()) throw Error(path + ": there are no columns in it");
}

bool CsvTable::has(std::string_view column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    if (found == columns_.end())
        throw Error(fmt::format("{}: there is no column '{}'", path_, name),
                    fmt::format("columns are {}", fmt::join(columns_, ", ")));
    return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& CsvTable::text(std::size_t row, std::string_view name) const {
    return rows_[row][column(name)].text;
}

double CsvTable::number(std::size_t row, std::string_view name) const {
    double value = 0.0;
    if (!read_number(text(row, name), value)) refuse(row, name, "a number");
    return value;
}

void CsvTable::refuse(std::size_t row, std::string_view name, std::string_view wanted) const {
    const Field& field = rows_[row][column(name)];
    throw Error(Loc{path_, field.line, field.column},
                fmt::format("'{}' wants {}, got '{}'", name, wanted, field.text));
}

}  // namespace spheroscope::reports
