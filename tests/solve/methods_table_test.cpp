// The table of methods in engine/README.md is written by hand; it must be that of the program.
#include "engine/solve/method.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" `");
    return begin == std::string::npos ? ""
                                      : text.substr(begin, text.find_last_not_of(" `") - begin + 1);
}

/// The first two columns of the table below '## Methods': name and order.
std::vector<std::pair<std::string, std::string>> table_of_methods() {
    std::ifstream readme(SPHEROSCOPE_SOURCE_DIR "/engine/README.md");
    std::vector<std::pair<std::string, std::string>> rows;
    std::string line;
    while (std::getline(readme, line) && line != "## Methods") continue;
    while (std::getline(readme, line) && !line.starts_with("|---")) continue;
    while (std::getline(readme, line) && line.starts_with("|")) {
        std::istringstream cells(line.substr(1));
        std::string name, order;
        std::getline(cells, name, '|');
        std::getline(cells, order, '|');
        rows.emplace_back(trimmed(name), trimmed(order));
    }
    return rows;
}

TEST(TableOfMethods, InTheReadmeHasTheMethodsOfTheProgramWithTheirOrders) {
    std::map<std::string, std::string> wanted;
    for (const MethodRow& method : all_methods())
        wanted.emplace(method.name, method.order > 0 ? std::to_string(method.order) : "none");
    const auto rows = table_of_methods();
    EXPECT_EQ(rows.size(), wanted.size()) << "each once";
    EXPECT_EQ((std::map<std::string, std::string>(rows.begin(), rows.end())), wanted);
}

}  // namespace
}  // namespace spheroscope
