// Both texts are made from the declarations that the command line is read with, so they cannot say
// anything else than `--help` does.
#include "engine/cli/reference.hpp"

#include <fmt/format.h>

#include <string_view>

namespace spheroscope::cli {
namespace {

/// For troff: "-" is a minus sign (as one types it), "\" and a leading "." or "'" mean something.
std::string for_man(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
            result += std::string("\\&") + c;
        else
            result += c;
    }
    return result;
}

/// Calls `use` for everything that the verb takes; the action that its declaration makes is
/// dropped.
void for_each_declared(const Verb& verb,
                       const std::function<void(const CommandLine::Declared&)>& use) {
    CommandLine command(verb.name, verb.summary);
    static_cast<void>(verb.declare(command));
    for (const CommandLine::Declared& declared : command.declared()) use(declared);
}

}  // namespace

std::string man_page(std::span<const Verb> verbs, const std::string& version) {
    std::string page = fmt::format(
        ".TH SPHEROSCOPE 1 \"\" \"spheroscope {}\" \"User Commands\"\n"
        ".SH NAME\nspheroscope \\- a microscope for mechanical stress in simulated tissue "
        "spheroids\n.SH SYNOPSIS\n.B spheroscope\n.I VERB\n[arguments]\n.SH VERBS\n",
        for_man(version));
    for (const Verb& verb : verbs) {
        page += fmt::format(".SS {}\n{}\n", verb.name, for_man(verb.summary));
        for_each_declared(verb, [&](const CommandLine::Declared& declared) {
            page +=
                fmt::format(".TP\n.B {}\n{}\n", for_man(declared.heading), for_man(declared.help));
        });
    }
    page += ".SH \"EXIT STATUS\"\n";
    for (const auto& [code, meaning] :
         {std::pair{"0", "ok"},
          {"1", "internal error"},
          {"2", "wrong command line or scene"},
          {"3", "unstable or not converged in the time it had"},
          {"4", "differs"},
          {"5", "something outside the program is missing (OpenGL, ffmpeg, display, disk space)"},
          {"130, 143", "ended by a signal, with a checkpoint"}})
        page += fmt::format(".TP\n.B {}\n{}\n", code, meaning);
    return page;
}

std::string bash_completion(std::span<const Verb> verbs) {
    std::string names, cases;
    for (const Verb& verb : verbs) {
        names += verb.name + " ";
        std::string options;
        for_each_declared(verb, [&](const CommandLine::Declared& declared) {
            for (const std::string& name : declared.long_names) options += name + " ";
        });
        options.pop_back();  // every verb has --help
        cases += fmt::format("        {}) options=\"{}\" ;;\n", verb.name, options);
    }
    return fmt::format("# bash completion of spheroscope: source <(spheroscope completion)\n"
                       "_spheroscope() {{\n"
                       "    local word=${{COMP_WORDS[COMP_CWORD]}} options=\n"
                       "    if ((COMP_CWORD == 1)); then\n"
                       "        COMPREPLY=($(compgen -W \"{}--help --version\" -- \"$word\"))\n"
                       "        return\n"
                       "    fi\n"
                       "    case ${{COMP_WORDS[1]}} in\n{}"
                       "    esac\n"
                       "    if [[ $word == -* ]]; then\n"
                       "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
                       "    else\n"
                       "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
                       "    fi\n"
                       "}}\n"
                       "complete -o filenames -F _spheroscope spheroscope ./spheroscope\n",
                       names, cases);
}

Verb man_verb(const std::vector<Verb>& verbs) {
    return {"man", "prints the manual page: spheroscope man | man -l -",
            [&verbs](CommandLine&) -> VerbAction {
                return [&verbs](const Invocation& invocation) {
                    fmt::print("{}", man_page(verbs, invocation.version));
                    return ExitCode::ok;
                };
            }};
}

Verb completion_verb(const std::vector<Verb>& verbs) {
    return {"completion", "prints a completion for bash: source <(spheroscope completion)",
            [&verbs](CommandLine&) -> VerbAction {
                return [&verbs](const Invocation&) {
                    fmt::print("{}", bash_completion(verbs));
                    return ExitCode::ok;
                };
            }};
}

}  // namespace spheroscope::cli
