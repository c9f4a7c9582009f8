// The manual page says what --help says, verb by verb and option by option, and the completion what
// the manual page says.
#include "tests/cli/program_runner.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace spheroscope {
namespace {

using Names = std::set<std::string>;

Names matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Names found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), regex);
         it != std::sregex_iterator(); ++it)
        found.insert((*it)[1]);
    return found;
}

class Reference : public ProgramRunner {
  protected:
    /// Every verb of --help, in its order.
    std::vector<std::string> verbs(Program program = Program::whole) const {
        std::vector<std::string> names;
        std::istringstream lines(call_with(program, {"--help"}).out);
        bool inside = false;
        for (std::string line; std::getline(lines, line);) {
            if (line == "Verbs:")
                inside = true;
            else if (line.empty())
                inside = false;
            else if (inside)
                names.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
        return names;
    }
    /// The long options that a verb's own --help declares: at the beginning of a line.
    Names options(Program program, const std::string& verb) const {
        return matches(call_with(program, {verb, "--help"}).out, "\n *(?:-[a-z], ?)?--([a-z-]+)");
    }
    std::string manual_page() const {
        return std::regex_replace(call({"man"}).out, std::regex("\\\\-"), "-");
    }
    /// The long options of a verb's section of the manual page.
    static Names options_in(const std::string& page, const std::string& verb) {
        const std::size_t begin = page.find("\n.SS " + verb + "\n");
        EXPECT_NE(begin, std::string::npos) << verb;
        if (begin == std::string::npos) return {};
        const std::size_t end = page.find("\n.S", begin + 1);
        return matches(page.substr(begin, end - begin + 1), "\n\\.B (?:-[a-z], )?--([a-z-]+)");
    }
};

TEST_F(Reference, TheManualPageHasTheVerbsAndOptionsOfHelpAndNoOthers) {
    const std::string page = manual_page();
    const std::vector<std::string> names = verbs(), of_engine = verbs(Program::engine);
    ASSERT_GT(names.size(), 8U);
    std::size_t n_options = 0;
    for (const std::string& verb : names) {
        const Names in_page = options_in(page, verb);
        // A verb without pictures is the same in both programs, and one of them starts faster.
        const bool is_of_engine =
            std::find(of_engine.begin(), of_engine.end(), verb) != of_engine.end();
        EXPECT_EQ(in_page, options(is_of_engine ? Program::engine : Program::whole, verb)) << verb;
        n_options += in_page.size();
    }
    EXPECT_GT(n_options, 40U) << "the control: there are options to compare";
    EXPECT_EQ(matches(page, "\n\\.SS ([a-z-]+)\n").size(), names.size());
}

TEST_F(Reference, TheManualPageIsOneForTroff) {
    const Outcome outcome = shell("command -v groff >/dev/null || exit 77; \"$PROGRAM\" man | "
                                  "groff -man -Tascii -P-cbou -ww");
    if (outcome.code == 77) GTEST_SKIP() << "no groff";
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("EXIT STATUS"), std::string::npos);
}

TEST_F(Reference, TheCompletionKnowsEveryVerbAndItsOptions) {
    ASSERT_EQ(shell("\"$PROGRAM\" completion > completion.bash").code, 0);
    const auto complete = [this](const std::string& words, int at) {
        const Outcome outcome = shell("bash -c 'source completion.bash; COMP_WORDS=(spheroscope " +
                                      words + "); COMP_CWORD=" + std::to_string(at) +
                                      "; _spheroscope; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
        return matches(outcome.out, "([^\n]+)");
    };
    const std::string page = manual_page();
    const std::vector<std::string> names = verbs();
    Names all(names.begin(), names.end());
    all.insert({"--help", "--version"});
    EXPECT_EQ(complete("\"\"", 1), all);
    EXPECT_EQ(complete("stab", 1), Names{"stability"});
    // One shell for all verbs: "= run" and then a line for each of its options.
    std::string script = "source completion.bash; COMP_CWORD=2;";
    std::string wanted;
    for (const std::string& verb : names) {
        script += " COMP_WORDS=(spheroscope " + verb + " --); _spheroscope; echo = " + verb +
                  "; printf \"%s\\n\" \"${COMPREPLY[@]}\" | LC_ALL=C sort;";
        wanted += "= " + verb + "\n";
        for (const std::string& option : options_in(page, verb)) wanted += "--" + option + "\n";
    }
    EXPECT_EQ(shell("bash -c '" + script + "'").out, wanted);
    write_file("scene.toml", "");
    EXPECT_EQ(complete("run sce", 2), Names{"scene.toml"});
}

}  // namespace
}  // namespace spheroscope
