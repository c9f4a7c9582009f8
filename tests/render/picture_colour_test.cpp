// What is drawn of a field, and in which colours.
#include "render/colour_maps.hpp"
#include "render/layers/force_network.hpp"
#include "render/picture.hpp"
#include "tests/render/pixels.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace spheroscope::render {
namespace {

using namespace synthetic;

/// A surface that faces the eye is lit by 0.40 + 0.60 cos(12 deg) = 0.987 of full light: 4 of 255
/// less; the middle of a mesh may be tilted a little.
constexpr int k_shading = 8;

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

}  // namespace
}  // namespace spheroscope::render
