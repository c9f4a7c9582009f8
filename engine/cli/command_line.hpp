#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// What may stand behind an option: a word for the help, and a check of the text as given, which
/// returns what is wrong with it, or nothing.
struct ValueRule {
    std::string type{};
    std::function<std::string(const std::string&)> check{};
};

/// Rules of numbers. The check says the range.
[[nodiscard]] ValueRule between(int least, int most);
[[nodiscard]] ValueRule between(double least, double most);
[[nodiscard]] ValueRule one_of(const std::vector<int>& values);

/// What a verb takes: it is declared once, and read, shown as help, manual page and completion from
/// the declaration. CLI11 does the work and is seen in command_line.cpp only: it takes longer to
/// compile than any verb. What is declared writes into the variable given, which must live until
/// `read`.
class CommandLine {
  public:
    CommandLine(const std::string& name, const std::string& summary);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// An argument without a dash; the ones that must be there come first.
    void argument(const std::string& name, std::string& value, const std::string& help);
    void optional_argument(const std::string& name, std::string& value, const std::string& help);
    void optional_arguments(const std::string& name, std::vector<std::string>& values,
                            const std::string& help);

    /// `names` as "--json" or "-o,--output".
    void flag(const std::string& names, bool& value, const std::string& help);
    void option(const std::string& names, std::string& value, const std::string& help,
                const ValueRule& rule = {});
    /// May be given several times.
    void option(const std::string& names, std::vector<std::string>& values, const std::string& help,
                const ValueRule& rule = {});
    void option(const std::string& names, int& value, const std::string& help,
                const ValueRule& rule = {});
    void option(const std::string& names, std::optional<int>& value, const std::string& help,
                const ValueRule& rule = {});
    void option(const std::string& names, std::optional<double>& value, const std::string& help,
                const ValueRule& rule = {});
    void option(const std::string& names, std::optional<std::uint64_t>& value,
                const std::string& help, const ValueRule& rule = {});

    /// What was declared, `--help` included, in its order.
    struct Declared {
        std::string heading;                  ///< "-o, --output PATH", "--json", "FILE"
        std::vector<std::string> long_names;  ///< "--output"; none for an argument
        std::string help;
    };
    [[nodiscard]] std::vector<Declared> declared() const;

    [[nodiscard]] std::string help() const;

    /// Reads the arguments behind the verb into the variables. Returns whether help was asked for.
    /// Throws Error (usage) on everything that was not declared, with a proposal.
    [[nodiscard]] bool read(const std::vector<std::string>& arguments);

  private:
    struct Library;
    std::unique_ptr<Library> m_library;
};

}  // namespace spheroscope::cli
