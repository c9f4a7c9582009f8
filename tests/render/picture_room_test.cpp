// How much room cells, bead and writing get in a picture.
#include "engine/run/aggregate_shape.hpp"
#include "render/layers/furniture.hpp"
#include "render/picture.hpp"
#include "tests/render/pixels.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace spheroscope::render {
namespace {

using namespace synthetic;

/// Rows that the nodes of a snapshot span in its picture.
std::array<double, 2> spanned_rows(const Snapshot& snapshot, const Camera& camera) {
    std::array<double, 2> rows{1e9, -1e9};
    for (std::size_t i = 0; i < snapshot.x_um.size() / 3; ++i) {
        const Vec3 x(static_cast<double>(snapshot.x_um[3 * i]),
                     static_cast<double>(snapshot.x_um[3 * i + 1]),
                     static_cast<double>(snapshot.x_um[3 * i + 2]));
        rows[0] = std::min(rows[0], camera.project(x).y);
        rows[1] = std::max(rows[1], camera.project(x).y);
    }
    return rows;
}

TEST(Picture, FitsTheAggregateIntoSixtyToNinetyPercentOfTheHeight) {
    // A round cell fills most; a small rough aggregate least.
    for (const auto& snapshot :
         {make_balls(make_header(1, 162), {{0, 0, 0}}, 9.0), make_aggregate(30, 42)}) {
        scene::Picture picture = make_picture("mean_stress");
        for (const double azimuth_deg : {0.0, 50.0, 200.0}) {
            picture.azimuth_deg = azimuth_deg;
            Renderer renderer(snapshot->header, picture);
            const auto [top, bottom] = spanned_rows(*snapshot, renderer.camera(*snapshot, {}));
            EXPECT_GT(bottom - top, 0.6 * 360);
            EXPECT_LT(bottom - top, 0.9 * 360);
            EXPECT_GT(top, 0.0);
            EXPECT_LT(bottom, 360.0);
        }
    }
}

TEST(Picture, ShowsItsCellsInAllSizesThatAreAllowed) {
    const auto snapshot = make_aggregate(3, 42);
    for (const std::array<int, 2> size : {std::array{64, 64},
                                          {128, 128},
                                          {200, 120},
                                          {128, 720},
                                          {720, 64},
                                          {64, 4096},
                                          {4096, 64}}) {
        scene::Picture picture = make_picture("normal_stress");
        picture.network = true;
        picture.smooth = false;
        picture.size_px = size;
        Renderer renderer(snapshot->header, picture);
        const Image image = renderer.render(*snapshot, {});
        const Camera camera = renderer.camera(*snapshot, {});
        EXPECT_GT(camera.px_per_um * shown_extent_um(*snapshot, renderer.picture()), 0.3 * 0.5 * 64)
            << size[0] << " x " << size[1];
        // Cells are most of the ink within their circle.
        int n_white = 0, n_all = 0;
        const double radius =
            0.5 * camera.px_per_um * shown_extent_um(*snapshot, renderer.picture());
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                if (std::hypot(x - camera.centre_x_px, y - camera.centre_y_px) < radius) {
                    ++n_all;
                    n_white += image.at(x, y) == Rgb{255, 255, 255} ? 1 : 0;
                }
        EXPECT_LT(n_white, n_all / 2) << size[0] << " x " << size[1];
    }
}

TEST(Picture, UnderABeadHasRoomForAllOfItAndOfTheCells) {
    const auto snapshot = make_aggregate(13, 42);
    const double cells_um = aggregate_extent_um(*snapshot);
    Probe& probe = snapshot->load.probe;
    probe.radius_um = 0.6 * cells_um;
    probe.direction = Vec3(0.0, 0.0, -1.0);
    probe.start_um = aggregate_centre_um(*snapshot) + Vec3(0.0, 0.0, 1.5 * cells_um);
    snapshot->load.hull = std::make_shared<const Hull>();
    const scene::Picture picture = front_picture("mean_stress");
    Renderer renderer(snapshot->header, picture);
    const Camera camera = renderer.camera(*snapshot, {});
    const double top = camera.project(probe.centre_um()).y - probe.radius_um * camera.px_per_um;
    const double bottom =
        camera.project(aggregate_centre_um(*snapshot)).y + cells_um * camera.px_per_um;
    EXPECT_GT(top, 0.0);
    EXPECT_LT(bottom, picture.size_px[1]);
    EXPECT_GT(bottom - top, 0.8 * picture.size_px[1]);  // and no room is wasted
    // Without it the cells are in the middle, and larger.
    probe = {};
    const Camera alone = renderer.camera(*snapshot, {});
    EXPECT_GT(alone.px_per_um, 1.3 * camera.px_per_um);
    EXPECT_LT(alone.project(aggregate_centre_um(*snapshot)).y,
              camera.project(aggregate_centre_um(*snapshot)).y);
}

TEST(Picture, PulledApartHasRoomBetweenCellsAndKeepsThemInside) {
    const std::vector<Vec3> centres{{0, -10, 0}, {0, 10, 0}};
    const auto snapshot = make_balls(make_header(2, 162), centres, 9.0);
    scene::Picture picture = front_picture("");
    Renderer renderer(snapshot->header, picture);
    const auto colour_at = [&](const Vec3& x) {
        return pixel_at(renderer.render(*snapshot, {}), renderer.camera(*snapshot, {}).project(x));
    };
    constexpr Rgb white{255, 255, 255};
    EXPECT_NE(colour_at({0, 5, 0}), white);
    picture.exploded = 1.0;  // cells at -20 and 20
    renderer.set_picture(picture);
    EXPECT_EQ(colour_at({0, 5, 0}), white);
    EXPECT_NE(colour_at({0, -20, 0}), white);
    EXPECT_NE(colour_at({0, 28, 0}), white);
    EXPECT_GT(renderer.camera(*snapshot, {}).project({0, -29, 0}).x, 0.0);
}

TEST(Picture, PulledApartMakesNoRoomForTheBeadThatItLeavesOut) {
    const auto snapshot = make_aggregate(13, 42);
    scene::Picture picture = front_picture("mean_stress");
    picture.exploded = 0.5;
    Renderer renderer(snapshot->header, picture);
    const Camera alone = renderer.camera(*snapshot, {});
    const Image image = renderer.render(*snapshot, {});
    Probe& probe = snapshot->load.probe;
    probe.radius_um = 2.0 * aggregate_extent_um(*snapshot);
    probe.direction = Vec3(0.0, 0.0, -1.0);
    probe.start_um = aggregate_centre_um(*snapshot) + Vec3(0.0, 0.0, 2.0 * probe.radius_um);
    snapshot->load.hull = std::make_shared<const Hull>();
    EXPECT_EQ(renderer.camera(*snapshot, {}).px_per_um, alone.px_per_um);
    EXPECT_EQ(shown_extent_um(*snapshot, picture), aggregate_extent_um(*snapshot));
    const Image under_load = renderer.render(*snapshot, {});
    // The cells are the same; beside them stand the notes of the load.
    int n_other = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = image.width / 3; x < image.width; ++x)
            n_other += under_load.at(x, y) == image.at(x, y) ? 0 : 1;
    EXPECT_LT(n_other, image.width * image.height / 200);
}

TEST(Picture, PulledApartSaysByHowMuch) {
    const auto snapshot = make_aggregate(13, 42);
    scene::Picture picture = make_picture("mean_stress");
    Renderer renderer(snapshot->header, picture);
    const auto ink_of_notes = [&] {
        const Image image = renderer.render(*snapshot, {});
        int n_ink = 0;
        for (int y = 60; y < image.height / 3; ++y)
            for (int x = 0; x < image.width / 8; ++x) n_ink += image.at(x, y).r < 160 ? 1 : 0;
        return n_ink;
    };
    const int without = ink_of_notes();
    picture.exploded = 0.5;
    renderer.set_picture(picture);
    EXPECT_GT(ink_of_notes(), without + 100);
}

TEST(Picture, ScaleBarHasItsLengthToAPixel) {
    const auto snapshot = make_balls(make_header(1, 642), {{0, 0, 0}}, 9.0);
    Renderer renderer(snapshot->header, make_picture(""));
    View view;
    view.fit_radius_um = 33.3;
    const Image image = renderer.render(*snapshot, view);
    const double px_per_um = renderer.camera(*snapshot, view).px_per_um;
    const double writing_scale = lay_out_furniture(image.width, image.height, {}).scale;
    const ScaleBar bar = make_scale_bar(image.width, image.height, writing_scale, px_per_um);
    ASSERT_EQ(bar.label, "20 µm");
    // The camera's scale itself: 20 um between two points across the view.
    const Camera camera = renderer.camera(*snapshot, view);
    EXPECT_NEAR(camera.project(20.0 * camera.right).x - camera.project(Vec3::Zero()).x,
                20.0 * px_per_um, 1e-9);
    int n_dark = 0;
    const int y = static_cast<int>(0.5 * (bar.y0 + bar.y1));
    for (int x = 0; x < image.width / 2; ++x)
        if (image.at(x, y).r < 140) ++n_dark;
    EXPECT_NEAR(n_dark, 20.0 * px_per_um, 1.0);
    // And the drawn cell has its diameter in the same scale, with a line of one pixel around it.
    int n_cell = 0;
    const int row = static_cast<int>(camera.centre_y_px);
    for (int x = 0; x < image.width; ++x)
        if (image.at(x, row) != Rgb{255, 255, 255}) ++n_cell;
    EXPECT_NEAR(n_cell, 18.0 * px_per_um + 2.0, 2.0);
}

TEST(Picture, WritingIsAtLeastSixteenPixelsHigh) {
    const auto snapshot = make_balls(make_header(1, 42), {{0, 0, 0}}, 9.0);
    Renderer renderer(snapshot->header, make_picture(""));
    const Image image = renderer.render(*snapshot, {});
    const ScaleBar bar = make_scale_bar(image.width, image.height,
                                        lay_out_furniture(image.width, image.height, {}).scale,
                                        renderer.camera(*snapshot, {}).px_per_um);
    // Rows with ink above the bar, in its width: the digits of its label.
    int top = image.height, bottom = 0;
    for (int y = static_cast<int>(bar.y0) - 40; y < static_cast<int>(bar.y0) - 9; ++y)
        for (int x = static_cast<int>(bar.x0); x < static_cast<int>(bar.x0) + 40; ++x)
            if (image.at(x, y).r < 160) {
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
    EXPECT_GE(bottom - top + 1, 16);
}

}  // namespace
}  // namespace spheroscope::render
