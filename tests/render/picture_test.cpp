#include "engine/run/aggregate_shape.hpp"
#include "render/colour_maps.hpp"
#include "render/layers/force_network.hpp"
#include "render/layers/furniture.hpp"
#include "render/picture.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace spheroscope::render {
namespace {

using namespace synthetic;

/// A look along the x axis at cells in the yz plane.
scene::Picture front_picture(const std::string& field) {
    scene::Picture picture = make_picture(field);
    picture.azimuth_deg = 0.0;
    picture.elevation_deg = 0.0;
    return picture;
}

Rgb pixel_at(const Image& image, const Camera::Pixel& p) {
    return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
}

/// Largest difference of a channel.
int distance(Rgb a, Rgb b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// A surface that faces the eye is lit by 0.40 + 0.60 cos(12 deg) = 0.987 of full light: 4 of 255
/// less; the middle of a mesh may be tilted a little.
constexpr int k_shading = 8;

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

TEST(Picture, StressAxesAreRedAlongTensionAndBlueAlongCompression) {
    auto header = make_header(1, 162);
    for (const std::string_view name : scene::k_stress_components)
        header->fields.push_back(find_field(name));
    const auto snapshot = make_balls(header, {{0, 0, 0}}, 9.0);
    snapshot->fields.resize(header->fields.size(), std::vector<float>(1, 0.0F));
    snapshot->fields[4][0] = 0.05F;   // yy
    snapshot->fields[5][0] = -0.05F;  // zz
    scene::Picture picture = front_picture("");
    picture.stress_axes = true;
    Renderer renderer(header, picture);
    const Image image = renderer.render(*snapshot, {});
    const Camera camera = renderer.camera(*snapshot, {});
    const Rgb along_y = pixel_at(image, camera.project({0, 6, 0}));
    const Rgb along_z = pixel_at(image, camera.project({0, 0, 6}));
    EXPECT_GT(along_y.r, along_y.b + 40);
    EXPECT_GT(along_z.b, along_z.r + 40);
    // The longest rod is as long as the cell, and nothing is drawn along the third axis.
    const Rgb beside = pixel_at(image, camera.project({0, 5, 5}));
    EXPECT_LT(std::abs(beside.r - beside.b), 40);
}

TEST(Picture, StressAxesOfARunWithoutTheComponentsAreRefused) {
    const auto snapshot = make_balls(make_header(1, 42), {{0, 0, 0}}, 9.0);
    scene::Picture picture = front_picture("");
    picture.stress_axes = true;
    EXPECT_THROW(Renderer(snapshot->header, picture), Error);
}

TEST(Picture, ACellHasTheMapsColourAndTheOppositeOneForTheOppositeStress) {
    const std::vector<Vec3> centres{{0, -10, 0}, {0, 10, 0}};
    const auto snapshot = make_balls(make_header(2, 162), centres, 9.0);
    Renderer renderer(snapshot->header, front_picture("mean_stress"));
    View view;
    view.range = Range{-100.0, 100.0};
    const ColourMap& map = ColourMap::diverging();
    for (const float sign : {1.0F, -1.0F}) {
        snapshot->fields[2] = {0.1F * sign, -0.05F * sign};  // kPa: 100 and -50 Pa
        const Image image = renderer.render(*snapshot, view);
        const Camera camera = renderer.camera(*snapshot, view);
        const double t = static_cast<double>(sign);
        EXPECT_LE(distance(pixel_at(image, camera.project(centres[0])), map.at(0.5 + 0.5 * t)),
                  k_shading);
        EXPECT_LE(distance(pixel_at(image, camera.project(centres[1])), map.at(0.5 - 0.25 * t)),
                  k_shading);
    }
}

TEST(Picture, EachPlaceOfAFieldColoursItsOwnPartOfTheSurface) {
    const std::vector<Vec3> centres{{0, -10, 0}, {0, 10, 0}};
    const auto snapshot = make_balls(make_header(2, 162), centres, 9.0);
    const MeshTopology& topology = *snapshot->header->topology;
    View view;
    view.range = Range{-100.0, 100.0};
    {
        // One triangle of the second cell: the one that faces the eye most.
        int facing = 0;
        double best = -1.0;
        Vec3 middle = Vec3::Zero();
        for (int t = 0; t < topology.n_triangles(); ++t) {
            const auto& nodes = topology.triangles[static_cast<std::size_t>(t)];
            Vec3 m = Vec3::Zero();
            for (const int node : nodes)
                m += topology.unit_shape[static_cast<std::size_t>(node)] / 3.0;
            if (m.x() > best) {
                best = m.x();
                facing = t;
                middle = m;
            }
        }
        snapshot->fields[1][static_cast<std::size_t>(topology.n_triangles() + facing)] = 0.1F;
        Renderer renderer(snapshot->header, front_picture("normal_stress"));
        const Image image = renderer.render(*snapshot, view);
        const Camera camera = renderer.camera(*snapshot, view);
        const Rgb hit = pixel_at(image, camera.project(centres[1] + 9.0 * middle));
        EXPECT_LE(distance(hit, ColourMap::diverging().at(1.0)), k_shading);
        const Rgb other = pixel_at(image, camera.project(centres[0] + 9.0 * middle));
        EXPECT_LE(distance(other, ColourMap::diverging().at(0.5)), k_shading);
    }
    {
        view.range = Range{0.0, 1.0};
        for (std::size_t i = 162; i < 324; ++i) snapshot->fields[0][i] = 1.0F;
        Renderer renderer(snapshot->header, front_picture("tension"));
        const Image image = renderer.render(*snapshot, view);
        const Camera camera = renderer.camera(*snapshot, view);
        EXPECT_LE(
            distance(pixel_at(image, camera.project(centres[1])), ColourMap::sequential().at(1.0)),
            k_shading);
        EXPECT_LE(
            distance(pixel_at(image, camera.project(centres[0])), ColourMap::sequential().at(0.0)),
            k_shading);
    }
}

TEST(Picture, ShowsNoContactAsGreyAndOutsideValuesAsMarks) {
    const std::vector<Vec3> centres{{0, -20, 0}, {0, 0, 0}, {0, 20, 0}};
    const auto snapshot = make_balls(make_header(3, 162), centres, 9.0);
    snapshot->fields[2] = {std::numeric_limits<float>::quiet_NaN(), 0.2F, -0.2F};
    Renderer renderer(snapshot->header, front_picture("mean_stress"));
    View view;
    view.range = Range{-100.0, 100.0};
    const Image image = renderer.render(*snapshot, view);
    const Camera camera = renderer.camera(*snapshot, view);
    const ColourMap& map = ColourMap::diverging();
    EXPECT_LE(distance(pixel_at(image, camera.project(centres[0])), k_absent_colour), k_shading);
    EXPECT_LE(distance(pixel_at(image, camera.project(centres[1])), map.above()), k_shading);
    EXPECT_LE(distance(pixel_at(image, camera.project(centres[2])), map.below()), k_shading);
}

TEST(Picture, ATubeCoversTheMiddleBetweenItsTwoCells) {
    const std::vector<Vec3> centres{{0, -14, 0}, {0, 14, 0}, {0, 0, 24}};
    const auto snapshot = make_balls(make_header(3, 162), centres, 9.0);
    scene::Picture picture = front_picture("");
    picture.network = true;
    Renderer renderer(snapshot->header, picture);
    const Camera camera = renderer.camera(*snapshot, {});
    const Camera::Pixel pushed = camera.project(0.5 * (centres[0] + centres[1]));
    const Camera::Pixel pulled = camera.project(0.5 * (centres[1] + centres[2]));
    const Image without = renderer.render(*snapshot, {});
    EXPECT_EQ(pixel_at(without, pushed), (Rgb{255, 255, 255}))
        << "between the cells there is nothing";

    snapshot->links = {{0, 1, 5.0F, 1.0F}, {1, 2, -5.0F, 1.0F}};
    const Image with = renderer.render(*snapshot, {});
    EXPECT_LE(distance(pixel_at(with, pushed), ForceNetwork::tube_colour(+5.0, 1.0)), k_shading);
    EXPECT_LE(distance(pixel_at(with, pulled), ForceNetwork::tube_colour(-5.0, 1.0)), k_shading);
    EXPECT_GT(pixel_at(with, pushed).b, pixel_at(with, pushed).r) << "compression is blue";
    EXPECT_GT(pixel_at(with, pulled).r, pixel_at(with, pulled).b) << "tension is red";
}

TEST(Picture, NetworkCountsTheLinksThatAreTooWeakToBeDrawn) {
    const auto snapshot = make_balls(make_header(3, 42), {{0, 0, 0}, {20, 0, 0}, {0, 20, 0}}, 9.0);
    snapshot->links = {{0, 1, 10.0F, 1.0F}, {0, 2, -10.0F, 1.0F}, {1, 2, 0.01F, 1.0F}};
    ForceNetwork network(9.0);
    const NetworkCount count = network.update(*snapshot);
    EXPECT_EQ(count.n_links, 3);
    EXPECT_EQ(count.n_left_out, 1);
    EXPECT_NEAR(count.mean_force_nN, 20.01 / 3.0, 1e-6);
}

TEST(Picture, CutawayLeavesOutTheNearCellsOnly) {
    const std::vector<Vec3> centres{{20, 0, 0}, {-20, 0, 0}};
    const auto snapshot = make_balls(make_header(2, 162), centres, 9.0);
    snapshot->fields[2] = {0.1F, -0.1F};
    View view;
    view.range = Range{-100.0, 100.0};
    scene::Picture picture = front_picture("mean_stress");
    for (const bool cutaway : {false, true}) {
        picture.cutaway = cutaway;
        Renderer renderer(snapshot->header, picture);
        const Image image = renderer.render(*snapshot, view);
        const Rgb seen = pixel_at(image, renderer.camera(*snapshot, view).project(centres[0]));
        EXPECT_LE(distance(seen, ColourMap::diverging().at(cutaway ? 0.0 : 1.0)), k_shading);
    }
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

TEST(Picture, OfSeedingShowsPlainCellsWithoutABar) {
    const auto snapshot = make_balls(make_header(2, 162), {{0, -10, 0}, {0, 10, 0}}, 9.0);
    scene::Picture picture = front_picture("mean_stress");
    Renderer renderer(snapshot->header, picture);
    View view;
    view.range = Range{-100.0, 100.0};
    const auto n_ink_on_the_right = [&](const Image& image) {
        int n = 0;
        for (int y = 0; y < image.height * 3 / 4; ++y)
            for (int x = image.width - 230; x < image.width; ++x)
                if (image.at(x, y) != Rgb{255, 255, 255}) ++n;
        return n;
    };
    EXPECT_GT(n_ink_on_the_right(renderer.render(*snapshot, view)), 1000);
    snapshot->stage_name = "anneal";
    snapshot->stage_progress = 0.43;
    const Image image = renderer.render(*snapshot, view);
    EXPECT_EQ(n_ink_on_the_right(image), 0);
    const Camera camera = renderer.camera(*snapshot, view);
    const Rgb a = pixel_at(image, camera.project({0, -10, 0}));
    const Rgb b = pixel_at(image, camera.project({0, 10, 0}));
    EXPECT_GT(distance(a, b), 10) << "cells are told apart";
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
