// A picture as a whole: neither empty nor by chance, and refused where it cannot be.
#include "render/layers/furniture.hpp"
#include "render/picture.hpp"
#include "tests/render/pixels.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <set>

namespace spheroscope::render {
namespace {

using namespace synthetic;

TEST(Picture, IsNeitherEmptyNorBlackNorOfOneColour) {
    const auto snapshot = make_aggregate(13, 42);
    Renderer renderer(snapshot->header, make_picture("mean_stress"));
    const Image image = renderer.render(*snapshot, {});
    ASSERT_EQ(image.width, 640);
    ASSERT_EQ(image.height, 360);
    int n_white = 0, n_black = 0;
    std::set<int> colours;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb c = image.at(x, y);
            if (c == Rgb{255, 255, 255}) ++n_white;
            if (c.r < 8 && c.g < 8 && c.b < 8) ++n_black;
            colours.insert((c.r << 16) | (c.g << 8) | c.b);
        }
    const int n_pixels = image.width * image.height;
    EXPECT_GT(n_white, n_pixels / 4);
    EXPECT_LT(n_white, n_pixels * 4 / 5);
    EXPECT_LT(n_black, n_pixels / 100);
    EXPECT_GT(colours.size(), 500U);
}

TEST(Picture, IsTheSameBitsTwice) {
    const auto snapshot = make_aggregate(13, 42);
    scene::Picture picture = make_picture("normal_stress");
    picture.network = true;
    Renderer first(snapshot->header, picture);
    const Image a = first.render(*snapshot, {}), b = first.render(*snapshot, {});
    Renderer second(snapshot->header, picture);
    const Image c = second.render(*snapshot, {});
    EXPECT_TRUE(a == b);
    EXPECT_TRUE(a == c);
    snapshot->fields[1][0] = 0.2F;
    snapshot->centre_um[0] += 3.0F;
    EXPECT_FALSE(a == first.render(*snapshot, {})) << "the comparison can fail";
}

TEST(Picture, InLowerQualityHasTheSameViewAndTheSameWriting) {
    const auto snapshot = make_aggregate(13, 162);
    scene::Picture picture = make_picture("mean_stress");
    picture.size_px = {641, 363};  // not twice a number
    Renderer renderer(snapshot->header, picture);
    View view;
    const Image full = renderer.render(*snapshot, view);
    const int keys =
        641 -
        static_cast<int>(lay_out_furniture(641, 363, {renderer.field(), false, false}).column_px);
    for (const Quality quality : {Quality::draft, Quality::coarse}) {
        view.quality = quality;
        const Image image = renderer.render(*snapshot, view);
        ASSERT_EQ(image.width, full.width);
        ASSERT_EQ(image.height, full.height);
        int n_far = 0, n_other_writing = 0;
        for (int y = 0; y < full.height; ++y)
            for (int x = 0; x < full.width; ++x) {
                n_far += distance(image.at(x, y), full.at(x, y)) > 24 ? 1 : 0;
                n_other_writing += x > keys && !(image.at(x, y) == full.at(x, y)) ? 1 : 0;
            }
        EXPECT_EQ(n_other_writing, 0);
        EXPECT_GT(n_far, 0);  // edges are not smooth
        EXPECT_LT(n_far, full.width * full.height / 12);
    }
    view.quality = Quality::full;
    EXPECT_TRUE(renderer.render(*snapshot, view) == full);  // drafts leave nothing behind
}

TEST(Picture, SaysWhichFieldsThereAreWhenTheWantedOneIsMissing) {
    const auto header = make_header(1, 42);
    try {
        const Renderer renderer(header, make_picture("gamma_eff"));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        const std::string text = error.what();
        EXPECT_NE(text.find("gamma_eff"), std::string::npos) << text;
        EXPECT_NE(text.find("tension, normal_stress, mean_stress"), std::string::npos) << text;
    }
}

TEST(Picture, RefusesSizesAndRangesThatCannotBe) {
    const auto header = make_header(1, 42);
    scene::Picture picture = make_picture("");
    picture.size_px = {640, 0};
    EXPECT_THROW(Renderer(header, picture), Error);
    picture = make_picture("tension");
    picture.range = "given";
    picture.given_range = {1.0, 1.0};
    EXPECT_THROW(Renderer(header, picture), Error);
}

TEST(Time, IsWrittenForPeople) {
    EXPECT_EQ(time_text(12.44, 1), "t = 12.4 s");
    EXPECT_EQ(time_text(0.0051, 3), "t = 0.005 s");
    EXPECT_EQ(time_text(750.2, 1), "t = 12 min 30 s");
}

}  // namespace
}  // namespace spheroscope::render
