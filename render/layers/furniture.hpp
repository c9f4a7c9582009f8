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

/// What is explained in the column on the right of a picture.
struct FurnitureParts {
    const Field* field = nullptr;  ///< nullptr: no colour bar
    bool network = false, stress_axes = false;
};

/// How large everything is that is written, and what of it has room. It follows from the picture
/// and not from a frame, so that nothing jumps in a movie.
struct FurnitureLayout {
    double scale = 1.0;      ///< of all sizes; 1 in a picture with 720 rows
    double column_px = 0.0;  ///< width of the column on the right; 0: there is none
    double bar_px = 0.0;     ///< height of the colour bar between its tips
    // In a small picture these are left out, the first one first.
    bool has_footer = true, has_counts = false, has_network_numbers = false, has_axes_key = false,
         has_network_key = false, has_bar_words = false, has_bar = false;
};
/// Sizes grow with the picture. Where not everything has room they shrink, down to letters that
/// can just be read; then the least important parts are left out. Cells always keep two fifths of
/// the width. A title that has no room beside the column stands where the footer would, and goes
/// only before the bar.
[[nodiscard]] FurnitureLayout lay_out_furniture(int width_px, int height_px,
                                                const FurnitureParts& parts);

/// A bar of a round length (1, 2, 5 times a power of ten) that tells the scale of a parallel view.
struct ScaleBar {
    double length_um = 0.0;
    double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< its rectangle, px
    std::string label;                              ///< "20 µm"
};
[[nodiscard]] ScaleBar make_scale_bar(int width_px, int height_px, double writing_scale,
                                      double px_per_um);

/// Everything that is written beside the cells.
struct Furniture {
    FurnitureLayout layout;
    std::string title;
    std::string difference;          ///< from the run beside it; empty: there is none
    std::string status;              ///< stage and time
    std::string short_status;        ///< stands where the status has no room
    std::vector<std::string> notes;  ///< measures of the whole aggregate
    std::string footer;              ///< name of the scene; gives way to a title without room
    double px_per_um = 1.0;

    const Field* field = nullptr;  ///< nullptr: no colour bar
    Range range;
    bool range_is_of_this_frame = false;
    ColourCount count;
    double paleness = 0.0;  ///< as used for the cells: the bar shows the colours of the picture

    std::optional<NetworkCount> network;
    /// The stress, kPa, of the longest rod of the principal axes; unset: they are not drawn.
    std::optional<double> longest_axis_kPa;
};

/// The place in the picture, px, of something that was drawn.
struct DrawnBox {
    std::string what;
    double x0, y0, x1, y1;
};
/// Returns where everything stands that was drawn, in no order.
std::vector<DrawnBox> draw_furniture(Image& image, TextPainter& text, const Furniture& furniture);

/// "t = 12.4 s", "t = 12 min 30 s"; `decimals` of the seconds below ten minutes.
[[nodiscard]] std::string time_text(double time_s, int decimals);
/// Each hyphen of a number as the sign that is as wide as a plus: "-1.2e-05".
[[nodiscard]] std::string minus_sign(std::string text);

}  // namespace spheroscope::render
