// The scenes of scenes/stress say what must hold of every method; here they are run.
#include "engine/reports/stability.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace spheroscope::reports {
namespace {

const std::filesystem::path k_folder =
    std::filesystem::path(SPHEROSCOPE_SOURCE_DIR) / "scenes" / "stress";

std::vector<std::string> stress_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(k_folder))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

class StressScene : public testing::TestWithParam<std::string> {};

TEST_P(StressScene, EndsOrStopsWithEveryMethodAsItSays) {
    const std::string file = k_folder / (GetParam() + ".toml");
    const auto rows = check_stability({file}, {}, {.threads = 1});
    const std::size_t n_variants =
        std::max<std::size_t>(1, scene::load_scene(file).variants.size());
    EXPECT_EQ(rows.size(), n_variants * all_methods().size());
    for (const StabilityRow& row : rows) {
        EXPECT_TRUE(row.was_run) << row.variant << ", " << row.method->name;
        EXPECT_TRUE(row.failures.empty()) << row.variant << ", " << row.method->name << ": "
                                          << fmt::format("{}", fmt::join(row.failures, "; "));
    }
}

INSTANTIATE_TEST_SUITE_P(All, StressScene, testing::ValuesIn(stress_scenes()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace spheroscope::reports
