#include "render/contact_sheet.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

namespace spheroscope::render {
namespace {

/// Two cells along x, the second of that radius and the first of 10 um, that do not touch.
Image sheet_of(double radius_um) {
    const auto header = synthetic::make_header(2, 162);
    header->radius_um = {10.0F, static_cast<float>(radius_um)};
    auto frame = synthetic::make_balls(header, {{-10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, 10.0);
    for (std::size_t i = frame->x_um.size() / 2; i < frame->x_um.size(); ++i) {
        const float middle = i % 3 == 0 ? 10.0F : 0.0F;
        frame->x_um[i] = middle + static_cast<float>(radius_um / 10.0) * (frame->x_um[i] - middle);
    }
    inspect::ContactMoment moment;
    moment.frame = frame;
    ContactSheet sheet(header, {0, 1});
    return sheet.draw(moment);
}

TEST(ContactSheet, ShowsTheWholeOfBothCellsAlsoWhereOneIsLarger) {
    for (const double radius_um : {10.0, 14.0, 20.0}) {
        const Image image = sheet_of(radius_um);
        // The columns at either side of both views, 520 x 380 px at (30, 140) and (30, 590), below
        // what is written into them.
        for (const int top : {140, 590}) {
            int n_ink = 0, n_inside = 0;
            for (int y = top + 24; y < top + 340; ++y) {
                for (const int x : {30, 31, 548, 549})
                    n_ink += image.at(x, y) == Rgb{255, 255, 255} ? 0 : 1;
                for (int x = 60; x < 520; ++x)
                    n_inside += image.at(x, y) == Rgb{255, 255, 255} ? 0 : 1;
            }
            EXPECT_EQ(n_ink, 0) << "a radius of " << radius_um << ", view at " << top;
            EXPECT_GT(n_inside, 10000);
        }
    }
}

}  // namespace
}  // namespace spheroscope::render
