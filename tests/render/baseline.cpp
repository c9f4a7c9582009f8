#include "tests/render/baseline.hpp"

#include "render/png.hpp"

#include <gtest/gtest.h>

namespace spheroscope::render {

namespace fs = std::filesystem;

namespace {
const std::string k_drawn_with = "Drawn with";
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
    const bool is_same_mesa = !drawn.with.empty() && baseline.texts.at(k_drawn_with) == drawn.with;
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

}  // namespace spheroscope::render
