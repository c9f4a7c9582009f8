#include "render/image_diff.hpp"

#include "engine/base/error.hpp"
#include "render/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace spheroscope::render {

namespace {

int distance(Rgb a, Rgb b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

void check_sizes(const Image& a, const Image& b) {
    const auto text = [](const Image& image) {
        return std::to_string(image.width) + " x " + std::to_string(image.height);
    };
    if (a.width != b.width || a.height != b.height)
        throw Error("two pictures of one size are wanted, got " + text(a) + " and " + text(b),
                    "draw both with one --set 'picture[0].size=[WIDTH, HEIGHT]'",
                    ExitCode::differs);
}

/// The smallest distance of a colour from the 3 x 3 pixels around (x, y).
int nearest_around(Rgb colour, const Image& image, int x, int y) {
    int smallest = 255;
    for (int v = std::max(0, y - 1); v <= std::min(image.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(image.width - 1, x + 1); ++u)
            smallest = std::min(smallest, distance(colour, image.at(u, v)));
    return smallest;
}

double grey(Rgb c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;  // ITU-R BT.709
}

/// Structural similarity of one block, Wang et al. 2004, eqn (13).
double block_similarity(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const double p = grey(a.at(x, y)), q = grey(b.at(x, y));
            sum_a += p;
            sum_b += q;
            sum_aa += p * p;
            sum_bb += q * q;
            sum_ab += p * q;
        }
    const double n = (x1 - x0) * (y1 - y0);
    const double mean_a = sum_a / n, mean_b = sum_b / n;
    const double var_a = sum_aa / n - mean_a * mean_a, var_b = sum_bb / n - mean_b * mean_b;
    const double covariance = sum_ab / n - mean_a * mean_b;
    constexpr double c1 = (0.01 * 255) * (0.01 * 255), c2 = (0.03 * 255) * (0.03 * 255);
    return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

}  // namespace

ImageDifference compare_images(const Image& reference, const Image& other, int threshold) {
    check_sizes(reference, other);
    ImageDifference result;
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.rgb.size(); ++i)
        sum += std::abs(reference.rgb[i] - other.rgb[i]);
    result.mean_difference = sum / static_cast<double>(reference.rgb.size());

    std::int64_t n_over = 0, n_over_shifted = 0;
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            const Rgb a = reference.at(x, y), b = other.at(x, y);
            const int here = distance(a, b);
            result.max_difference = std::max(result.max_difference, here);
            if (here <= threshold) continue;
            ++n_over;
            if (std::max(nearest_around(a, other, x, y), nearest_around(b, reference, x, y)) >
                threshold)
                ++n_over_shifted;
        }
    const double n_pixels = static_cast<double>(reference.rgb.size()) / 3.0;
    result.share_over_threshold = static_cast<double>(n_over) / n_pixels;
    result.share_over_threshold_shifted = static_cast<double>(n_over_shifted) / n_pixels;

    constexpr int side = 8;
    double similarity = 0.0;
    int n_blocks = 0;
    for (int y = 0; y < reference.height; y += side)
        for (int x = 0; x < reference.width; x += side, ++n_blocks) {
            const double here =
                block_similarity(reference, other, x, y, std::min(x + side, reference.width),
                                 std::min(y + side, reference.height));
            similarity += here;
            result.worst_similarity = std::min(result.worst_similarity, here);
        }
    result.similarity = similarity / n_blocks;
    return result;
}

std::vector<std::string> broken_bounds(const ImageDifference& d, const ImageTolerance& tolerance) {
    // Asked this way round, a bound that is not a number is broken and never met.
    std::vector<std::string> broken;
    if (d.max_difference > tolerance.max_difference)
        broken.push_back(fmt::format("a channel differs by {}, allowed are {}", d.max_difference,
                                     tolerance.max_difference));
    if (!(d.share_over_threshold_shifted <= tolerance.shifted_share))
        broken.push_back(fmt::format("{:.3g} of the pixels differ also when edges may move by a "
                                     "pixel, allowed are {:.3g}",
                                     d.share_over_threshold_shifted, tolerance.shifted_share));
    if (!(d.similarity >= tolerance.similarity))
        broken.push_back(fmt::format("the similarity is {:.5f}, wanted are {:.5f} or more",
                                     d.similarity, tolerance.similarity));
    return broken;
}

std::string blank_reason(const Image& image) {
    if (image.rgb.empty()) return "has no pixels";
    // What a renderer leaves behind that drew nothing. Its own pictures are mostly white and have
    // dark writing on less than a tenth, so both bounds are far away from them.
    constexpr int one_colour = 4, black = 16;
    constexpr double most = 0.99;
    const Rgb first = image.at(0, 0);
    bool is_one_colour = true;
    std::int64_t n_black = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb c = image.at(x, y);
            is_one_colour = is_one_colour && distance(c, first) <= one_colour;
            if (std::max({c.r, c.g, c.b}) < black) ++n_black;
        }
    if (static_cast<double>(n_black) >= most * image.width * image.height) return "is black";
    return is_one_colour ? "has one colour all over" : "";
}

Image difference_sheet(const Image& reference, const Image& other) {
    check_sizes(reference, other);
    const int stride = reference.width + k_sheet_gap_px;
    Image sheet(3 * stride - k_sheet_gap_px, reference.height + k_sheet_header_px, {200, 200, 200});
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x) {
            const Rgb a = reference.at(x, y), b = other.at(x, y);
            // A root makes small differences visible: 1 of 255 gives 16.
            const auto shade = static_cast<std::uint8_t>(
                255 - std::lround(255.0 * std::sqrt(distance(a, b) / 255.0)));
            sheet.set(x, y + k_sheet_header_px, a);
            sheet.set(x + stride, y + k_sheet_header_px, b);
            sheet.set(x + 2 * stride, y + k_sheet_header_px, {shade, shade, shade});
        }
    TextPainter text;
    int x = 0;
    for (const char* name : {"reference", "new", "difference"}) {
        text.draw(sheet, x + k_sheet_gap_px, 0.7 * k_sheet_header_px, name, {});
        x += stride;
    }
    return sheet;
}

}  // namespace spheroscope::render
