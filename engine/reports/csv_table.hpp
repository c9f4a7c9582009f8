#pragma once

#include "engine/base/error.hpp"

#include <charconv>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::reports {

/// A file that ReportTable::csv_text has written, read again.
class CsvTable {
  public:
    /// Throws Error with file and line for a file that cannot be read, has no columns, a row of
    /// another length than they, or a quotation without an end.
    explicit CsvTable(const std::string& path);

    [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
    [[nodiscard]] std::size_t n_rows() const { return rows_.size(); }
    [[nodiscard]] bool has(std::string_view column) const;
    /// Throws Error when there is no such column.
    [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
    /// Whether a word stands for what is missing ("-").
    [[nodiscard]] bool is_missing(std::size_t row, std::string_view column) const {
        return text(row, column) == "-";
    }
    /// NaN where it is missing. Throws Error for any other text that is no number.
    [[nodiscard]] double number(std::size_t row, std::string_view column) const;
    /// Throws Error for what is missing, no whole number or too large for its type.
    template <std::integral Integer>
    [[nodiscard]] Integer integer(std::size_t row, std::string_view column) const {
        const std::string& digits = text(row, column);
        Integer value = 0;
        const char* const end = digits.data() + digits.size();
        const auto [read, error] = std::from_chars(digits.data(), end, value);
        if (error == std::errc::result_out_of_range) refuse(row, column, "a smaller whole number");
        if (error != std::errc() || read != end) refuse(row, column, "a whole number");
        return value;
    }
    /// Throws Error: the field at this place wants something else.
    [[noreturn]] void refuse(std::size_t row, std::string_view column,
                             std::string_view wanted) const;

  private:
    struct Field {
        std::string text;
        int line = 1, column = 1;  ///< of the file, from 1
    };
    [[nodiscard]] static std::vector<Field> next_record(const std::string& text, std::size_t& at,
                                                        int& line, const std::string& path);
    [[nodiscard]] std::size_t column(std::string_view name) const;

    std::string path_;
    std::vector<std::string> comments_, columns_;
    std::vector<std::vector<Field>> rows_;
};

/// "1.5" as 1.5, "-" as NaN; false for anything else.
[[nodiscard]] bool read_number(const std::string& text, double& value);

}  // namespace spheroscope::reports
