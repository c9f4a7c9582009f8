// The README lists what --help lists: a verb that is added and not described fails here.
#include "tests/cli/program_runner.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>

namespace spheroscope {
namespace {

using Words = std::vector<std::string>;

Words matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Words found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), regex);
         it != std::sregex_iterator(); ++it)
        found.push_back((*it)[1]);
    std::sort(found.begin(), found.end());
    return found;
}

/// From `begin` on to the next `end`.
std::string part_of(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    EXPECT_NE(from, std::string::npos) << begin;
    if (from == std::string::npos) return "";
    const std::size_t inside = from + begin.size();
    return text.substr(inside, text.find(end, inside) - inside);
}

class Readme : public ProgramRunner {
  protected:
    const std::string help_ = call({"--help"}).out;
    static std::string text() {
        std::ifstream file(SPHEROSCOPE_SOURCE_DIR "/README.md");
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

TEST_F(Readme, HasARowForEveryVerbAndForNoOther) {
    const Words verbs = matches("\n" + part_of(help_, "Verbs:\n", "\nOptions:"), "\n  ([a-z-]+) ");
    ASSERT_GT(verbs.size(), 10U) << help_;
    // The first column, each verb in code with its arguments: "`run SCENE|FILE`", "`man`,
    // `doctor`".
    Words rows;
    for (const std::string& cell : matches(part_of(text(), "| verb | |\n|---|---|\n", "\n\n"),
                                           "(?:^|\n)\\| ((?:`[^`]*`|, )+) \\|"))
        for (const std::string& verb : matches(cell, "`([a-z-]+)[^`]*`")) rows.push_back(verb);
    std::sort(rows.begin(), rows.end());
    const bool has_pictures = std::binary_search(verbs.begin(), verbs.end(), "movie");
    if (has_pictures)
        EXPECT_EQ(rows, verbs);
    else  // the verbs that draw are missing in such a build, not in the README
        EXPECT_TRUE(std::includes(rows.begin(), rows.end(), verbs.begin(), verbs.end())) << help_;
}

TEST_F(Readme, HasARowForEveryExitCodeOfHelp) {
    const Words codes = matches(part_of(help_, "Exit codes:", "\n\n"), "[ \n]([0-9]+)[ ,]");
    ASSERT_EQ(codes.size(), 9U) << help_;
    Words rows;
    for (const std::string& cell :
         matches(part_of(text(), "| code | meaning |\n|---|---|\n", "\n\n"),
                 "(?:^|\n)\\| ([0-9, ]+) \\|"))
        for (const std::string& code : matches(cell, "([0-9]+)")) rows.push_back(code);
    std::sort(rows.begin(), rows.end());
    EXPECT_EQ(rows, codes);
}

}  // namespace
}  // namespace spheroscope
