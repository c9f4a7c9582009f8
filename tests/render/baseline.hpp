#pragma once

#include "render/image.hpp"
#include "render/image_diff.hpp"

#include <filesystem>
#include <string>

// tests/render/baselines/NAME.png are small pictures that must stay as they are until a person has
// looked. Each holds the text "Drawn with". Where the same Mesa and VTK draw, every bit counts;
// elsewhere edges may move by a pixel and generated code may round differently. A picture that
// differs is left in the build folder beside a sheet with the difference: look at both, then copy
// it, and say in the commit what changed.
namespace spheroscope::render {

constexpr int k_threshold = 24;
/// Elsewhere. One cell of the other sign is a twentieth of the pixels.
constexpr ImageTolerance k_other_machine{255, 0.002, 0.98};

struct Drawn {
    Image image;
    std::string with;  ///< what drew it; "": not even the same machine has each bit again
};

[[nodiscard]] std::filesystem::path baseline_path(const std::string& name);
/// Fails the test unless the picture is the baseline's.
void expect_as_baseline(const std::string& name, const Drawn& drawn);

}  // namespace spheroscope::render
