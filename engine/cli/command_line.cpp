#include "engine/cli/command_line.hpp"

#include "engine/base/error.hpp"
#include "engine/base/nearest_word.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

namespace spheroscope::cli {
namespace {

/// A check of the library's, with its words.
ValueRule rule_of(const CLI::Validator& validator) {
    return {{}, [validator](const std::string& text) {
                std::string copy = text;
                return validator(copy);
            }};
}

/// The first argument that the verb has no use for, as an error.
Error unexpected_argument(const std::string& argument, const CommandLine& command,
                          const std::string& hint) {
    if (argument.rfind('-', 0) != 0)
        return Error(fmt::format("unexpected argument '{}'", argument), hint);
    std::vector<std::string> names;
    for (const CommandLine::Declared& option : command.declared())
        names.insert(names.end(), option.long_names.begin(), option.long_names.end());
    const std::string meant = nearest_word(argument.substr(0, argument.find('=')), names);
    return Error(fmt::format("unknown option '{}'{}", argument,
                             meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant)),
                 hint);
}

std::string heading_of(const CLI::Option& option) {
    if (!option.nonpositional()) return option.get_single_name();
    std::string names;
    for (const std::string& name : option.get_snames()) names += "-" + name + ", ";
    for (const std::string& name : option.get_lnames()) names += "--" + name + ", ";
    names.resize(names.size() - 2);
    const bool takes_value = option.get_items_expected_max() > 0;
    return takes_value ? names + " " + option.get_type_name() : names;
}

}  // namespace

ValueRule between(int least, int most) { return rule_of(CLI::Range(least, most)); }

ValueRule between(double least, double most) {
    const ValueRule range = rule_of(CLI::Range(least, most));
    // The library compares, and 'not a number' is neither below nor above anything.
    return {{}, [range](const std::string& text) {
                double number = 0.0;
                if (CLI::detail::lexical_cast(text, number) && std::isnan(number))
                    return fmt::format("wanted a number, got '{}'", text);
                return range.check(text);
            }};
}

ValueRule one_of(const std::vector<int>& values) { return rule_of(CLI::IsMember(values)); }

struct CommandLine::Library {
    CLI::App app;

    template <class Value> CLI::Option& option(const std::string& names, Value& value,
                                               const std::string& help, const ValueRule& rule) {
        CLI::Option* option = app.add_option(names, value, help);
        if (!rule.type.empty()) option->type_name(rule.type);
        if (rule.check) option->check(rule.check);
        // A job script with a variable that is not set: not the same as no option.
        option->check([](const std::string& text) {
            return std::string(text.empty() ? "wanted a value, got ''" : "");
        });
        return *option;
    }
};

CommandLine::CommandLine(const std::string& name, const std::string& summary)
    : m_library(new Library{CLI::App(summary, "spheroscope " + name)}) {
    m_library->app.allow_extras();  // so that they can be reported with a proposal
}

CommandLine::~CommandLine() = default;

void CommandLine::argument(const std::string& name, std::string& value, const std::string& help) {
    m_library->option(name, value, help, {}).required();
}

void CommandLine::optional_argument(const std::string& name, std::string& value,
                                    const std::string& help) {
    m_library->option(name, value, help, {});
}

void CommandLine::optional_arguments(const std::string& name, std::vector<std::string>& values,
                                     const std::string& help) {
    m_library->option(name, values, help, {});
}

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
    m_library->app.add_flag(names, value, help);
}

void CommandLine::option(const std::string& names, std::string& value, const std::string& help,
                         const ValueRule& rule) {
    m_library->option(names, value, help, rule);
}

void CommandLine::option(const std::string& names, std::vector<std::string>& values,
                         const std::string& help, const ValueRule& rule) {
    // one value each time: what follows it is not another one
    m_library->option(names, values, help, rule).allow_extra_args(false);
}

void CommandLine::option(const std::string& names, int& value, const std::string& help,
                         const ValueRule& rule) {
    m_library->option(names, value, help, rule);
}

void CommandLine::option(const std::string& names, std::optional<int>& value,
                         const std::string& help, const ValueRule& rule) {
    m_library->option(names, value, help, rule);
}

void CommandLine::option(const std::string& names, std::optional<double>& value,
                         const std::string& help, const ValueRule& rule) {
    m_library->option(names, value, help, rule);
}

void CommandLine::option(const std::string& names, std::optional<std::uint64_t>& value,
                         const std::string& help, const ValueRule& rule) {
    m_library->option(names, value, help, rule);
}

std::vector<CommandLine::Declared> CommandLine::declared() const {
    std::vector<Declared> result;
    for (const CLI::Option* option : std::as_const(m_library->app).get_options()) {
        Declared declared{heading_of(*option), {}, option->get_description()};
        for (const std::string& name : option->get_lnames())
            declared.long_names.push_back("--" + name);
        result.push_back(declared);
    }
    return result;
}

std::string CommandLine::help() const { return m_library->app.help(); }

bool CommandLine::read(const std::vector<std::string>& arguments) {
    CLI::App& app = m_library->app;
    const std::string hint = fmt::format("{} --help lists what the verb takes", app.get_name());
    try {
        // the library takes the arguments from the back
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        return true;
    } catch (const CLI::ParseError& error) {
        throw Error(error.what(), hint);
    }
    const std::vector<std::string> unexpected = app.remaining();
    if (!unexpected.empty()) throw unexpected_argument(unexpected.front(), *this, hint);
    return false;
}

}  // namespace spheroscope::cli
