#include "engine/base/error.hpp"
#include "render/canvas.hpp"
#include "render/image_diff.hpp"

#include <gtest/gtest.h>

namespace spheroscope::render {
namespace {

Image with_square(double x, double y, Rgb colour = {200, 30, 30}) {
    Image image(64, 48);
    fill_rectangle(image, x, y, x + 20, y + 20, colour);
    return image;
}

TEST(ImageDiff, OfEqualPicturesIsNothing) {
    const ImageDifference d = compare_images(with_square(10, 10), with_square(10, 10));
    EXPECT_EQ(d.max_difference, 0);
    EXPECT_EQ(d.mean_difference, 0.0);
    EXPECT_EQ(d.share_over_threshold, 0.0);
    EXPECT_DOUBLE_EQ(d.similarity, 1.0);
}

TEST(ImageDiff, SeesAChangedColourInThePixelsThatHaveIt) {
    const ImageDifference d =
        compare_images(with_square(10, 10), with_square(10, 10, {200, 130, 30}));
    EXPECT_EQ(d.max_difference, 100);
    EXPECT_NEAR(d.share_over_threshold, 400.0 / (64 * 48), 1e-12);
    EXPECT_NEAR(d.share_over_threshold_shifted, 400.0 / (64 * 48), 1e-12);
    EXPECT_NEAR(d.mean_difference, 100.0 * 400 / (3 * 64 * 48), 1e-9);
    EXPECT_LT(d.similarity, 1.0);
}

TEST(ImageDiff, ForgivesAnEdgeThatMovedByOnePixelButNotByThree) {
    const ImageDifference one = compare_images(with_square(10, 10), with_square(11, 10));
    EXPECT_GT(one.share_over_threshold, 0.0);
    EXPECT_EQ(one.share_over_threshold_shifted, 0.0);
    const ImageDifference three = compare_images(with_square(10, 10), with_square(13, 10));
    EXPECT_GT(three.share_over_threshold_shifted, 0.0);
    EXPECT_LT(three.similarity, one.similarity);
}

TEST(ImageDiff, RefusesPicturesOfTwoSizes) {
    EXPECT_THROW(static_cast<void>(compare_images(Image(4, 4), Image(4, 5))), Error);
}

TEST(ImageDiff, SheetShowsBothAndDarkensWhereTheyDiffer) {
    const Image a = with_square(10, 10), b = with_square(30, 10);
    const Image sheet = difference_sheet(a, b);
    EXPECT_EQ(sheet.width, 3 * 64 + 16);
    EXPECT_EQ(sheet.at(15, 15), a.at(15, 15));
    EXPECT_EQ(sheet.at(72 + 35, 15), b.at(35, 15));
    EXPECT_LT(sheet.at(144 + 35, 15).r, 100);
    EXPECT_EQ(sheet.at(144 + 60, 45), (Rgb{255, 255, 255}));
}

}  // namespace
}  // namespace spheroscope::render
