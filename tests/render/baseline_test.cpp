// Pictures of made-up snapshots as they are must stay as they are until a person has looked.
#include "render/image_diff.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "tests/render/baseline.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace spheroscope::render {
namespace {

Drawn draw(const Snapshot& snapshot, const scene::Picture& picture) {
    Renderer renderer(snapshot.header, picture);
    return {renderer.render(snapshot, {}), renderer.drawn_with()};
}

/// Thirteen cells of 162 nodes: one in the middle, twelve around it.
std::shared_ptr<Snapshot> cluster() { return synthetic::make_aggregate(13, 162); }

/// As high as pictures are by default, so that everything written has its room.
scene::Picture picture_of(const std::string& field) {
    scene::Picture picture = synthetic::make_picture(field);
    picture.size_px = {960, 720};
    return picture;
}

scene::Picture network_picture() {
    scene::Picture picture = picture_of("normal_stress");
    picture.cutaway = picture.network = true;
    return picture;
}

TEST(Baseline, OfCellsInTheirMeanStress) {
    expect_as_baseline("mean_stress", draw(*cluster(), picture_of("mean_stress")));
}

TEST(Baseline, OfTheInsideWithContactStressAndNetwork) {
    expect_as_baseline("inside", draw(*cluster(), network_picture()));
}

TEST(Baseline, OfTensionWithoutSmoothing) {
    scene::Picture picture = picture_of("tension");
    picture.smooth = false;
    expect_as_baseline("tension_not_smooth", draw(*cluster(), picture));
}

TEST(Baseline, IsNotMetByAPictureThatShowsSomethingElse) {
    // Tolerant bounds, as on another machine: each of these must be seen there as well.
    const auto is_seen = [](const Drawn& drawn, const std::string& name) {
        const Image baseline = read_png(baseline_path(name)).image;
        return !broken_bounds(compare_images(baseline, drawn.image, k_threshold), k_other_machine)
                    .empty();
    };
    const scene::Picture cells = picture_of("mean_stress");
    EXPECT_FALSE(is_seen(draw(*cluster(), cells), "mean_stress")) << "the control";

    auto opposite = cluster();
    for (float& value : opposite->fields[2]) value = -value;
    EXPECT_TRUE(is_seen(draw(*opposite, cells), "mean_stress"));

    // The red cell in front.
    auto one_cell = cluster();
    float& tension = *std::max_element(one_cell->fields[2].begin(), one_cell->fields[2].end());
    tension = -tension;
    EXPECT_TRUE(is_seen(draw(*one_cell, cells), "mean_stress"));

    auto other_signs = cluster();
    for (ContactLink& link : other_signs->links) link.force_nN = -link.force_nN;
    EXPECT_TRUE(is_seen(draw(*other_signs, network_picture()), "inside"));

    scene::Picture turned = cells;
    turned.azimuth_deg += 3.0;
    EXPECT_TRUE(is_seen(draw(*cluster(), turned), "mean_stress"));
}

}  // namespace
}  // namespace spheroscope::render
