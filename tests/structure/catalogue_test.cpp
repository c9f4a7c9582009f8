// Comments in tests cite rows of the catalogue of checks: "C-15". tests/README.md has the
// catalogue.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace spheroscope::test {
namespace {

namespace fs = std::filesystem;

const fs::path k_tests = fs::path(SPHEROSCOPE_SOURCE_DIR) / "tests";

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), regex);
         it != std::sregex_iterator(); ++it)
        found.insert((*it)[1]);
    return found;
}

TEST(Catalogue, HasARowForEveryCodeThatATestCites) {
    const std::set<std::string> rows = matches(text_of(k_tests / "README.md"), "\n\\| (C-[0-9]+)");
    EXPECT_GE(rows.size(), 27U);
    std::size_t n_cited = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(k_tests)) {
        if (entry.path().extension() != ".cpp") continue;
        for (const std::string& code : matches(text_of(entry.path()), "\\b(C-[0-9]+)")) {
            ++n_cited;
            EXPECT_TRUE(rows.contains(code)) << code << " in " << entry.path();
        }
    }
    EXPECT_GT(n_cited, 10U) << "the control: codes are found";
}

TEST(Catalogue, NamesFilesThatExist) {
    const std::set<std::string> files =
        matches(text_of(k_tests / "README.md"), "`((?:scenes/)?[a-z_]+/[a-z_/]+\\.[a-z]+)`");
    EXPECT_GT(files.size(), 25U);
    for (const std::string& file : files)
        EXPECT_TRUE(fs::exists(k_tests / file) || fs::exists(k_tests.parent_path() / file)) << file;
}

}  // namespace
}  // namespace spheroscope::test
