#include "engine/cli/program.hpp"

#include "engine/base/nearest_word.hpp"
#include "engine/cli/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <new>
#include <string_view>
#include <system_error>

namespace spheroscope::cli {
namespace {

const std::string k_verbs_hint = "spheroscope --help lists the verbs";

std::string help_text(std::span<const Verb> verbs) {
    std::string text = "A microscope for mechanical stress in simulated tissue spheroids.\n\n"
                       "Usage: spheroscope VERB [arguments]\n\nVerbs:\n";
    for (const Verb& verb : verbs) text += fmt::format("  {:<12}{}\n", verb.name, verb.summary);
    text += "\nOptions:\n"
            "  --help    this text; after a verb: its arguments\n"
            "  --version version and commit\n\n"
            "Exit codes: 0 ok, 1 internal error, 2 wrong command line or scene, 3 unstable or not\n"
            "converged in the time it had, 4 differs, 5 something outside the program is missing\n"
            "(OpenGL, ffmpeg, disk space), 129, 130 and 143 after a signal, with a checkpoint.\n";
    return text;
}

const Verb& find_verb(const std::string& name, std::span<const Verb> verbs) {
    std::vector<std::string> names;
    for (const Verb& verb : verbs) {
        if (verb.name == name) return verb;
        names.push_back(verb.name);
    }
    const std::string meant = nearest_word(name, names);
    throw Error(fmt::format("unknown verb '{}'{}", name,
                            meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant)),
                k_verbs_hint);
}

ExitCode run_verb(const Verb& verb, const std::vector<std::string>& arguments,
                  const std::string& version) {
    CommandLine command(verb.name, verb.summary);
    const VerbAction action = verb.declare(command);
    if (command.read({arguments.begin() + 1, arguments.end()})) {
        fmt::print("{}", command.help());
        return ExitCode::ok;
    }
    return action(Invocation{command_line_text(arguments), version});
}

ExitCode dispatch(const std::vector<std::string>& arguments, std::span<const Verb> verbs,
                  const std::string& version) {
    if (arguments.empty()) {
        print_to_stderr(help_text(verbs));
        return ExitCode::usage;
    }
    const std::string& first = arguments.front();
    if (first == "--help" || first == "-h" || first == "help") {
        fmt::print("{}", help_text(verbs));
        return ExitCode::ok;
    }
    if (first == "--version") {
        fmt::print("spheroscope {}\n", version);
        return ExitCode::ok;
    }
    if (first.rfind('-', 0) == 0)
        throw Error(fmt::format("wanted a verb first, got the option '{}'", first), k_verbs_hint);
    return run_verb(find_verb(first, verbs), arguments, version);
}

}  // namespace

std::string command_line_text(const std::vector<std::string>& arguments) {
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_-+=./:,@%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    std::string text = "spheroscope";
    for (const std::string& argument : arguments) {
        text += ' ';
        if (!argument.empty() && std::all_of(argument.begin(), argument.end(), is_plain)) {
            text += argument;
            continue;
        }
        text += '\'';
        for (const char c : argument) text += c == '\'' ? "'\\''" : std::string(1, c);
        text += '\'';
    }
    return text;
}

void open_standard_streams() {
    // Each takes the lowest number that is free, which is the one that was found closed. What goes
    // to stdout must not get lost: a write to a file that is open for reading fails.
    constexpr std::array k_modes{O_RDONLY, O_RDONLY, O_WRONLY};
    for (int stream = 0; stream < 3; ++stream)
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            static_cast<void>(open("/dev/null", k_modes[static_cast<std::size_t>(stream)]));
}

ExitCode run_program(const std::vector<std::string>& arguments, std::span<const Verb> verbs,
                     const std::string& version) {
    try {
        start_log();
        const ExitCode code = dispatch(arguments, verbs, version);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw Error("the result could not be written to stdout", "is the disk full?",
                        ExitCode::environment);
        return code;
    } catch (const Error& error) {
        print_error(error.what());
        return error.code();
    } catch (const std::system_error& error) {  // files, and a full stdout
        print_error(fmt::format("error: {}", std::ferror(stdout) != 0
                                                 ? "the result could not be written to stdout\n  "
                                                   "hint: is the disk full?"
                                                 : error.what()));
        return ExitCode::environment;
    } catch (const std::bad_alloc&) {
        print_error("error: out of memory");
        return ExitCode::environment;
    } catch (const std::exception& error) {
        print_error(fmt::format("internal error: {}\n  hint: this is a mistake of the program; "
                                "the command line and this message help to find it",
                                error.what()));
        return ExitCode::internal;
    }
}

}  // namespace spheroscope::cli
