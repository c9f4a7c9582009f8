#include "engine/cli/options.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace spheroscope::cli {
namespace {

std::string message_of(const std::function<void()>& f) {
    try {
        f();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(CommonOptions, SetSplitsAtTheFirstEqualsSign) {
    CommonOptions options;
    options.set = {"cells.nodes=642", "scene.title=a=b", "scene.title="};
    const auto overrides = options.overrides();
    ASSERT_EQ(overrides.size(), 3U);
    EXPECT_EQ(overrides[0].key, "cells.nodes");
    EXPECT_EQ(overrides[0].value, "642");
    EXPECT_EQ(overrides[1].value, "a=b");
    EXPECT_EQ(overrides[2].value, "");
}

TEST(CommonOptions, SetWithoutKeyOrEqualsSignIsAMistake) {
    for (const std::string text : {"cells.nodes", "=642"}) {
        CommonOptions options;
        options.set = {text};
        EXPECT_EQ(message_of([&] { static_cast<void>(options.overrides()); }),
                  "error: --set wants key=value, got '" + text +
                      "'\n  hint: for instance --set cells.nodes=642");
    }
}

TEST(CommonOptions, TheSeedComesAfterWhatIsSet) {
    CommonOptions options;
    options.set = {"scene.seed=1"};
    options.seed = 18446744073709551615U;
    const auto overrides = options.overrides();
    ASSERT_EQ(overrides.size(), 2U);
    EXPECT_EQ(overrides[1].key, "scene.seed");
    EXPECT_EQ(overrides[1].value, "18446744073709551615");
}

TEST(CommonOptions, ThreadsNotGivenAreAtLeastOne) {
    CommonOptions options;
    EXPECT_GE(options.n_threads(), 1);
    options.threads = 7;
    EXPECT_EQ(options.n_threads(), 7);
}

TEST(CommonOptions, TimeLimitIsATimeAboveZeroOrNotGiven) {
    CommonOptions options;
    EXPECT_FALSE(options.time_limit_s());
    options.time_limit = "90 s";
    EXPECT_EQ(options.time_limit_s(), 90.0);
    for (const char* wrong : {"0 s", "-1 s", "soon", "3 um"}) {
        options.time_limit = wrong;
        EXPECT_EQ(message_of([&] {
                      static_cast<void>(options.time_limit_s());
                  }).rfind("error: --time-limit wants a time above zero, got \"", 0),
                  0U)
            << wrong;
    }
}

}  // namespace
}  // namespace spheroscope::cli
