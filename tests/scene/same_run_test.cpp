// Which resolved scenes make the same run.
#include "engine/scene/same_run.hpp"
#include "engine/scene/scene.hpp"
#include "tests/scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace spheroscope::scene {
namespace {

const std::string k_pictures = "[[picture]]\nfield = \"curvature\"\n";

std::string resolved(const std::vector<Override>& overrides = {},
                     const std::string& pictures = k_pictures) {
    return parse_scene(k_drop + "[measures]\nfields = [\"curvature\"]\n" + pictures, "a.toml",
                       overrides)
        .resolved_toml;
}

TEST(SameRun, DoesNotDependOnPictures) {
    const std::string text = resolved();
    ASSERT_NE(text.find("[[picture]]"), std::string::npos);
    EXPECT_TRUE(is_same_run(text, text));
    EXPECT_TRUE(is_same_run(text, resolved({{"picture[0].size", "[640, 360]"}})));
    EXPECT_TRUE(is_same_run(resolved({}, ""), text));
    EXPECT_TRUE(is_same_run(text, resolved({}, "")));
    EXPECT_TRUE(is_same_run(text, resolved({}, k_pictures + "[[picture]]\nname = \"second\"\n")));
}

TEST(SameRun, IsThatOfAnEarlierVersionWhichDidNotKnowAKeyThatHasItsDefault) {
    const std::string text = resolved();
    const std::string key = "\ntime_error = false";
    std::string stored = text;
    ASSERT_NE(stored.find(key), std::string::npos) << stored;
    stored.erase(stored.find(key), key.size());
    EXPECT_TRUE(is_same_run(stored, text));
    EXPECT_FALSE(is_same_run(stored, resolved({{"measures.time_error", "true"}})));
}

TEST(SameRun, IsNotThatOfPicturesOfAFieldThatItsFramesDoNotHave) {
    EXPECT_FALSE(is_same_run(resolved(), resolved({{"picture[0].field", "strain"}})));
}

TEST(SameRun, IsNotThatOfOtherParametersOrOfATextThatIsNoScene) {
    EXPECT_FALSE(is_same_run(resolved(), resolved({{"cortex.tension.gamma", "0.6 nN/um"}})));
    EXPECT_FALSE(is_same_run(resolved(), resolved({{"scene.seed", "7"}})));
    EXPECT_FALSE(is_same_run("no scene", resolved()));
}

}  // namespace
}  // namespace spheroscope::scene
