// Pictures as they are must stay as they are until a person has looked.
//
// tests/render/baselines/NAME.png are small pictures of made-up snapshots. Each holds the text
// "Drawn with". Where the same Mesa and VTK draw, every bit counts; elsewhere edges may move by a
// pixel and generated code may round differently. A picture that differs is left in the build
// folder beside a sheet with the difference: look at both, then copy it, and say in the commit what
// changed.
#include "render/image_diff.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace spheroscope::render {
namespace {

namespace fs = std::filesystem;

constexpr int k_threshold = 24;
/// Elsewhere. One cell of the other sign is a twentieth of the pixels.
constexpr ImageTolerance k_other_machine{255, 0.002, 0.98};
const std::string k_drawn_with = "Drawn with";

struct Drawn {
    Image image;
    std::string with;
};

Drawn draw(const Snapshot& snapshot, const scene::Picture& picture) {
    Renderer renderer(snapshot.header, picture);
    return {renderer.render(snapshot, {}), renderer.drawn_with()};
}

fs::path baseline_path(const std::string& name) {
    return fs::path(SPHEROSCOPE_SOURCE_DIR) / "tests/render/baselines" / (name + ".png");
}

void expect_as_baseline(const std::string& name, const Drawn& drawn) {
    EXPECT_EQ(blank_reason(drawn.image), "");
    const fs::path folder = fs::path(SPHEROSCOPE_BINARY_DIR) / "baselines";
    fs::create_directories(folder);
    const auto keep = [&] {
        write_png(folder / (name + ".png"), drawn.image, {{k_drawn_with, drawn.with}});
        return (folder / (name + ".png")).string();
    };
    if (!fs::exists(baseline_path(name)))
        FAIL() << "no baseline yet: look at " << keep() << ", then copy it to "
               << baseline_path(name);
    const PngFile baseline = read_png(baseline_path(name));
    ASSERT_EQ(blank_reason(baseline.image), "");
    const bool is_same_mesa = baseline.texts.at(k_drawn_with) == drawn.with;
    const ImageDifference d = compare_images(baseline.image, drawn.image, k_threshold);
    std::string reasons;
    for (const std::string& reason :
         broken_bounds(d, is_same_mesa ? ImageTolerance{} : k_other_machine))
        reasons += "\n  " + reason;
    if (reasons.empty()) return;
    const fs::path sheet = folder / (name + "_sheet.png");
    write_png(sheet, difference_sheet(baseline.image, drawn.image));
    ADD_FAILURE() << name << " differs (" << (is_same_mesa ? "same" : "other")
                  << " Mesa):" << reasons << "\nlook at " << sheet << ", and at " << keep();
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
