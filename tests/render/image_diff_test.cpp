#include "engine/base/error.hpp"
#include "render/canvas.hpp"
#include "render/image_diff.hpp"

#include <gtest/gtest.h>

#include <limits>

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

TEST(ImageDiff, SimilarityOfTwoPlainGreysIsThatOfTheirLuminanceAlone) {
    // Wang et al. 2004, eqn (13) without variance: (2 p q + c1) / (p^2 + q^2 + c1), c1 = 2.55^2
    const ImageDifference d =
        compare_images(Image(16, 16, {100, 100, 100}), Image(16, 16, {150, 150, 150}));
    const double p = 100.0, q = 150.0, c1 = 2.55 * 2.55;
    EXPECT_NEAR(d.similarity, (2 * p * q + c1) / (p * p + q * q + c1), 1e-12);
    EXPECT_NEAR(d.worst_similarity, d.similarity, 1e-12);
}

TEST(ImageDiff, SimilarityOfOppositePatternsIsNegative) {
    // Two chess boards of 100 and 155, one shifted by a field: equal means, variance v = 27.5^2,
    // covariance -v: (c2 - 2 v) / (2 v + c2) with c2 = 7.65^2 in the left half; 1 in the right one.
    Image a(16, 8), b(16, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool odd = ((x + y) & 1) != 0;
            const std::uint8_t p = odd ? 100 : 155, q = odd == (x < 8) ? 155 : 100;
            a.set(x, y, {p, p, p});
            b.set(x, y, {q, q, q});
        }
    const double v = 27.5 * 27.5, c2 = 7.65 * 7.65;
    const double opposite = (c2 - 2 * v) / (2 * v + c2);
    const ImageDifference d = compare_images(a, b);
    EXPECT_NEAR(d.worst_similarity, opposite, 1e-9);
    EXPECT_NEAR(d.similarity, 0.5 * (opposite + 1.0), 1e-9);
}

TEST(ImageDiff, EveryBoundOfTheToleranceCanBeTheOneThatIsBroken) {
    const Image reference = with_square(10, 10);
    const auto n_broken = [&](const Image& other, const ImageTolerance& tolerance) {
        return broken_bounds(compare_images(reference, other), tolerance).size();
    };
    EXPECT_EQ(n_broken(reference, {}), 0U);
    Image one_bit = reference;
    one_bit.set(0, 0, {254, 255, 255});
    EXPECT_EQ(n_broken(one_bit, {}), 1U) << "every bit counts";
    const ImageTolerance edges{255, 0.0, -1.0}, alike{255, 1.0, 0.99};
    EXPECT_EQ(n_broken(one_bit, edges), 0U);
    EXPECT_EQ(n_broken(with_square(11, 10), edges), 0U);
    EXPECT_EQ(n_broken(with_square(13, 10), edges), 1U);
    EXPECT_EQ(n_broken(one_bit, alike), 0U);
    EXPECT_EQ(n_broken(with_square(13, 10), alike), 1U);
    EXPECT_EQ(n_broken(with_square(13, 10), {0, 0.0, 0.99}), 3U);
}

TEST(ImageDiff, ABoundThatIsNotANumberIsMetByNothing) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const ImageDifference none = compare_images(with_square(10, 10), with_square(10, 10));
    EXPECT_EQ(broken_bounds(none, {255, nan, -1.0}).size(), 1U);
    EXPECT_EQ(broken_bounds(none, {255, 1.0, nan}).size(), 1U);
}

TEST(ImageDiff, APictureOfNothingIsFoundOut) {
    EXPECT_EQ(blank_reason(Image(64, 48)), "has one colour all over");
    EXPECT_EQ(blank_reason(Image(64, 48, {3, 0, 9})), "is black");
    Image nearly_black(64, 48, {0, 0, 0});
    for (int x = 0; x < 20; ++x) nearly_black.set(x, 0, {255, 255, 255});
    EXPECT_EQ(blank_reason(nearly_black), "is black") << "20 of 3072 pixels are less than 1 %";
    EXPECT_EQ(blank_reason(with_square(10, 10)), "");
    EXPECT_EQ(blank_reason(Image()), "has no pixels");
}

TEST(ImageDiff, RefusesPicturesOfTwoSizes) {
    try {
        static_cast<void>(compare_images(Image(4, 4), Image(4, 5)));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::differs);
        EXPECT_NE(std::string(error.what()).find("4 x 4 and 4 x 5"), std::string::npos);
    }
}

TEST(ImageDiff, SheetShowsBothAndDarkensWhereTheyDiffer) {
    const Image a = with_square(10, 10), b = with_square(30, 10);
    const Image sheet = difference_sheet(a, b);
    constexpr int top = k_sheet_header_px, stride = 64 + k_sheet_gap_px;
    EXPECT_EQ(sheet.width, 3 * 64 + 2 * k_sheet_gap_px);
    EXPECT_EQ(sheet.height, 48 + top);
    EXPECT_EQ(sheet.at(15, top + 15), a.at(15, 15));
    EXPECT_EQ(sheet.at(stride + 35, top + 15), b.at(35, 15));
    EXPECT_LT(sheet.at(2 * stride + 35, top + 15).r, 100);
    EXPECT_EQ(sheet.at(2 * stride + 60, top + 45), (Rgb{255, 255, 255}));
}

}  // namespace
}  // namespace spheroscope::render
