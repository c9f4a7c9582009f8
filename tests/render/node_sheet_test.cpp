#include "render/image_diff.hpp"
#include "render/node_sheet.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace spheroscope::render {
namespace {

constexpr Rgb k_first{0, 114, 178};  // the colour of the first row
constexpr double k_longest_px = 0.40 * 390;

/// Node 5 of a ball, with one force of a term.
inspect::NodeMoment moment_with(double outward_nN, double along_nN) {
    const auto frame = synthetic::make_balls(synthetic::make_header(1, 162), {Vec3::Zero()}, 9.0);
    inspect::NodeMoment moment{frame, {}};
    moment.forces.cell = 0;
    moment.forces.node = 5;
    const std::size_t at = 15;
    const Vec3 outward(double{frame->normal[at]}, double{frame->normal[at + 1]},
                       double{frame->normal[at + 2]});
    const Vec3 force = outward_nN * outward + along_nN * outward.unitOrthogonal();
    moment.forces.terms = {{"cytosol", force}};
    moment.forces.drive_nN = moment.forces.residual_nN = force;
    moment.forces.scale_nN = force.norm();
    return moment;
}

struct Extent {
    int n = 0, x0 = 10000, x1 = -1, y0 = 10000, y1 = -1;
};
/// Of the pixels of this colour in a part of the sheet.
Extent extent_of(const Image& sheet, Rgb colour, int x0, int y0, int width, int height) {
    Extent extent;
    for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x) {
            const Rgb c = sheet.at(x, y);
            if (c.r != colour.r || c.g != colour.g || c.b != colour.b) continue;
            ++extent.n;
            extent.x0 = std::min(extent.x0, x);
            extent.x1 = std::max(extent.x1, x);
            extent.y0 = std::min(extent.y0, y);
            extent.y1 = std::max(extent.y1, y);
        }
    return extent;
}
Extent from_the_side(const Image& sheet) { return extent_of(sheet, k_first, 30, 140, 700, 390); }
Extent from_outside(const Image& sheet) { return extent_of(sheet, k_first, 30, 580, 700, 390); }

TEST(NodeSheet, DrawsAnOutwardForceUpwardAsLongAsItIs) {
    const Image sheet = NodeSheet().draw(moment_with(2.0, 0.0));
    EXPECT_EQ(blank_reason(sheet), "");
    const Extent side = from_the_side(sheet);
    const int node_y = 140 + 195;
    EXPECT_NEAR(side.y0, node_y - k_longest_px, 30.0);  // beyond the tip stands its number
    EXPECT_LT(side.y1, node_y);
    EXPECT_NEAR(0.5 * (side.x0 + side.x1), 380.0, 6.0);
    EXPECT_EQ(from_outside(sheet).n, 0);  // it points at the reader there
}

TEST(NodeSheet, DrawsAnInwardForceDownward) {
    const Extent side = from_the_side(NodeSheet().draw(moment_with(-2.0, 0.0)));
    const int node_y = 140 + 195;
    EXPECT_GT(side.y0, node_y);
    EXPECT_NEAR(side.y1, node_y + k_longest_px, 30.0);
}

TEST(NodeSheet, DrawsAForceAlongTheSurfaceToTheRightInBothViews) {
    const Image sheet = NodeSheet().draw(moment_with(0.0, 3.0));
    for (const Extent& extent : {from_the_side(sheet), from_outside(sheet)}) {
        EXPECT_GT(extent.x0, 380);
        EXPECT_NEAR(extent.x1, 380.0 + k_longest_px, 30.0);
    }
}

TEST(NodeSheet, OfANodeWithoutForcesHasNoArrows) {
    const Image sheet = NodeSheet().draw(moment_with(0.0, 0.0));
    EXPECT_EQ(from_the_side(sheet).n, 0);
    EXPECT_EQ(blank_reason(sheet), "");
}

TEST(NodeSheet, OfARunWithALongTitleKeepsItsOwnReadable) {
    auto moment = moment_with(1.0, 0.0);
    const auto heading = [&](const std::string& title) {
        auto header = std::make_shared<RunHeader>(*moment.frame->header);
        header->title = title;
        auto frame = std::make_shared<Snapshot>(*moment.frame);
        frame->header = header;
        moment.frame = frame;
        const Image sheet = NodeSheet().draw(moment);
        std::vector<Rgb> pixels;
        for (int y = 20; y < 60; ++y)
            for (int x = 0; x < 630; ++x) pixels.push_back(sheet.at(x, y));
        return pixels;
    };
    EXPECT_TRUE(heading("Short") == heading(std::string(300, 'w')));
}

TEST(NodeSheet, SaysWhereItIsFrom) {
    const auto texts = node_sheet_texts(moment_with(1.0, 0.0), "0.1", "spheroscope inspect");
    EXPECT_NE(texts.at("Title").find("Forces on node 5 of cell 0"), std::string::npos);
    EXPECT_EQ(texts.at("Command"), "spheroscope inspect");
}

}  // namespace
}  // namespace spheroscope::render
