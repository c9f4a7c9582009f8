// What is written beside the cells keeps clear of itself and of the picture's edges, in every size.
#include "render/layers/furniture.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace spheroscope::render {
namespace {

constexpr std::array<std::array<int, 2>, 16> k_sizes{{{640, 360},
                                                      {900, 400},
                                                      {1280, 720},
                                                      {960, 720},
                                                      {720, 1280},
                                                      {1080, 1080},
                                                      {480, 300},
                                                      {320, 180},
                                                      {200, 120},
                                                      {128, 720},
                                                      {720, 128},
                                                      {128, 128},
                                                      {64, 64},
                                                      {4096, 64},
                                                      {64, 4096},
                                                      {4096, 4096}}};

const Field& contact_stress() { return *synthetic::make_header(1, 42)->fields[1]; }

/// All that can stand beside cells, in one frame.
Furniture everything(const FurnitureLayout& layout) {
    Furniture furniture;
    furniture.layout = layout;
    furniture.title = "A title that is a good deal longer than most of them are";
    furniture.difference = "seed = 2, cells.nodes = 642, cortex.elastic.E = 320 kPa";
    furniture.status = "indent   t = 187.00 s";
    furniture.short_status = "t = 187.00 s";
    furniture.notes = {"Z = 12.5", "contact area 100 %", "bead 1500.0 nN", "way 14.51 µm"};
    furniture.footer = "a_scene_with_a_long_name_of_its_file.toml";
    furniture.px_per_um = 3.0;
    furniture.field = &contact_stress();
    furniture.range = {-80.0, 80.0};
    furniture.range_is_of_this_frame = true;
    furniture.count = {1000, 4, 5, 6};
    furniture.network = NetworkCount{12345, 1234, 2.95, 0.4};
    furniture.longest_axis_kPa = 1.234;
    return furniture;
}

std::vector<DrawnBox> drawn_in(int width_px, int height_px, Range range = {-80.0, 80.0},
                               const Field& field = contact_stress()) {
    Image image(width_px, height_px);
    TextPainter text;
    Furniture furniture = everything(lay_out_furniture(width_px, height_px, {&field, true, true}));
    furniture.field = &field;
    furniture.range = range;
    return draw_furniture(image, text, furniture);
}

bool overlap(const DrawnBox& a, const DrawnBox& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

bool has(const std::vector<DrawnBox>& boxes, const std::string& what) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const DrawnBox& box) {
        return box.what.find(what) != std::string::npos;
    });
}

TEST(Furniture, IsInsideThePictureAndNoPartHidesAnother) {
    for (const auto& [width, height] : k_sizes) {
        const std::vector<DrawnBox> boxes = drawn_in(width, height);
        EXPECT_TRUE(has(boxes, "scale bar")) << width << " x " << height;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const DrawnBox& box = boxes[i];
            EXPECT_TRUE(box.x0 >= 0.0 && box.y0 >= 0.0 && box.x1 <= width && box.y1 <= height)
                << box.what << " leaves " << width << " x " << height << ": " << box.x0 << " to "
                << box.x1 << ", " << box.y0 << " to " << box.y1;
            for (std::size_t k = i + 1; k < boxes.size(); ++k)
                EXPECT_FALSE(overlap(box, boxes[k]))
                    << box.what << " and " << boxes[k].what << " in " << width << " x " << height;
        }
    }
}

TEST(Furniture, IsCompleteFrom640By360On) {
    for (const auto& [width, height] : {std::array{640, 360}, {900, 400}, {1280, 720}}) {
        const std::vector<DrawnBox> boxes = drawn_in(width, height);
        for (const char* what :
             {"A title", "seed = 2", "indent", "way 14.51", "µm", "a_scene", "σ^c_nn (Pa)",
              "this frame", "colour bar", "no contact", "above", "below", "contact force",
              "compression", "1234 of 12345 left out", "principal stress", "longest"})
            EXPECT_TRUE(has(boxes, what)) << what << " in " << width << " x " << height;
    }
}

TEST(Furniture, LeavesOutTheLeastImportantFirst) {
    const FurnitureParts parts{&contact_stress(), true, true};
    const auto kept = [&](int width, int height) {
        const FurnitureLayout l = lay_out_furniture(width, height, parts);
        return std::array{l.has_bar,      l.has_bar_words,       l.has_network_key,
                          l.has_axes_key, l.has_network_numbers, l.has_counts,
                          l.has_footer};
    };
    std::size_t n_before = 0;
    for (int height = 64; height <= 720; ++height) {
        const auto flags = kept(1280, height);
        const auto n = static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
        EXPECT_TRUE(std::is_partitioned(flags.begin(), flags.end(), [](bool is) { return is; }))
            << height;
        EXPECT_GE(n, n_before) << height;
        n_before = n;
    }
    EXPECT_EQ(n_before, 7U);
    EXPECT_FALSE(kept(1280, 64)[0]);
    EXPECT_EQ(lay_out_furniture(128, 720, parts).column_px, 0.0) << "cells need the width";
    EXPECT_EQ(lay_out_furniture(1280, 720, parts).scale, 1.0);
    EXPECT_EQ(lay_out_furniture(3840, 2160, parts).scale, 3.0);
}

TEST(Furniture, WithRoomForOneLineOnlyHasTheTitleAndNotTheFilesName) {
    for (const int width : {197, 200, 204, 211})
        for (const int height : {150, 180, 200, 300}) {
            const std::vector<DrawnBox> boxes = drawn_in(width, height);
            EXPECT_TRUE(has(boxes, "A title")) << width << " x " << height;
            EXPECT_TRUE(has(boxes, "σ^c_nn (Pa)")) << width << " x " << height;
            EXPECT_FALSE(has(boxes, "a_scene")) << width << " x " << height;
        }
    EXPECT_TRUE(has(drawn_in(240, 300), "A title")) << "beside the bar";
}

TEST(Furniture, LeavesOutTheTitleBeforeWhatTellsTwoRunsApartAndThatBeforeTheTime) {
    const auto shown = [](int height) {
        const std::vector<DrawnBox> boxes = drawn_in(1280, height);
        return std::array{has(boxes, "A title"), has(boxes, "seed = 2"), has(boxes, "t = 187")};
    };
    std::array<bool, 3> before{false, false, false};
    for (int height = 64; height <= 200; height += 4) {
        const std::array now = shown(height);
        EXPECT_TRUE(now[2] || !now[1]) << height;
        EXPECT_TRUE(now[1] || !now[0]) << height;
        before = now;
    }
    EXPECT_EQ(before, (std::array{true, true, true}));
}

TEST(ColourBar, SaysTensionAndCompressionOfNormalStressesAlone) {
    const auto n_tension = [](const char* name) {
        const auto boxes = drawn_in(1280, 720, {-80.0, 80.0}, *find_field(name));
        return std::count_if(boxes.begin(), boxes.end(), [](const DrawnBox& box) {
            return box.what.find("tension") != std::string::npos;
        });
    };
    // Keys of contact forces and principal axes say it too, whatever the field.
    const auto n_elsewhere = n_tension("neighbours");
    for (const char* normal : {"sigma_h", "gamma_eff", "stress_xx"})
        EXPECT_EQ(n_tension(normal), n_elsewhere + 1) << normal;
    for (const char* shear : {"stress_xy", "stress_xz", "stress_yz"})
        EXPECT_EQ(n_tension(shear), n_elsewhere) << shear;
}

TEST(ColourBar, HasTwoLabelsOrMoreWhateverItsRange) {
    // At 360 rows its ticks are so close that not all of them have labels.
    for (const double high : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 250.0}) {
        int n_labels = 0;
        for (const DrawnBox& box : drawn_in(640, 360, {-high, high})) {
            std::string digits = box.what;
            if (digits.rfind("\u2212", 0) == 0) digits.erase(0, std::string("\u2212").size());
            n_labels += digits.find_first_not_of("0123456789.") == std::string::npos ? 1 : 0;
        }
        EXPECT_GE(n_labels, 3) << high;
    }
}

TEST(ColourBar, HasLabelsThatDifferHoweverNarrowItsRange) {
    for (const Range range : {Range{100.0, 100.0001}, Range{-2e-7, 2e-7}, Range{3e6, 3.0001e6}})
        for (const int height : {360, 720}) {
            std::vector<std::string> labels;
            for (const DrawnBox& box : drawn_in(640, height, range))
                if (box.what.find_first_not_of("0123456789.e+-\u2212") == std::string::npos)
                    labels.push_back(box.what);
            ASSERT_GE(labels.size(), 2U);
            std::sort(labels.begin(), labels.end());
            EXPECT_EQ(std::adjacent_find(labels.begin(), labels.end()), labels.end())
                << labels.front() << " stands twice from " << range.low;
        }
}

}  // namespace
}  // namespace spheroscope::render
