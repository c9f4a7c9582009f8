#pragma once

#include "engine/measures/fields.hpp"
#include "render/image.hpp"
#include "render/layers/colouring.hpp"
#include "render/layers/force_network.hpp"
#include "render/range.hpp"
#include "render/text.hpp"

#include <optional>
#include <string>
#include <vector>

namespace spheroscope::render {

/// A bar of a round length (1, 2, 5 times a power of ten) that tells the scale of a parallel view.
struct ScaleBar {
    double length_um = 0.0;
    double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< its rectangle, px
    std::string label;                              ///< "20 µm"
};
[[nodiscard]] ScaleBar make_scale_bar(int width_px, int height_px, double px_per_um);

/// Everything that is written beside the cells.
struct Furniture {
    std::string title;
    std::string status;              ///< stage and time
    std::vector<std::string> notes;  ///< measures of the whole aggregate
    std::string footer;              ///< name of the scene
    double px_per_um = 1.0;

    const Field* field = nullptr;  ///< nullptr: no colour bar
    Range range;
    bool range_is_of_this_frame = false;
    ColourCount count;
    double paleness = 0.0;  ///< as used for the cells: the bar shows the colours of the picture

    std::optional<NetworkCount> network;
    /// The stress, kPa, of the longest rod of the principal axes; unset: they are not drawn.
    std::optional<double> longest_axis_kPa;

    [[nodiscard]] bool has_keys() const { return network || longest_axis_kPa; }
};

/// Height of the picture over which all sizes of writing scale; text never gets smaller than at 720
/// rows.
[[nodiscard]] double writing_scale(int height_px);
/// Width of the column on the right that bar and keys need, px; 0 without both.
[[nodiscard]] double key_column_px(int height_px, bool has_field, bool has_keys);

void draw_furniture(Image& image, TextPainter& text, const Furniture& furniture);

/// "t = 12.4 s", "t = 12 min 30 s"; `decimals` of the seconds below ten minutes.
[[nodiscard]] std::string time_text(double time_s, int decimals);
/// Each hyphen of a number as the sign that is as wide as a plus: "-1.2e-05".
[[nodiscard]] std::string minus_sign(std::string text);

}  // namespace spheroscope::render
