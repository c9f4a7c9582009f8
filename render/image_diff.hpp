#pragma once

#include "render/image.hpp"

#include <string>
#include <vector>

namespace spheroscope::render {

/// How far two pictures of one size are apart. Differences are of one channel, 0..255.
struct ImageDifference {
    int max_difference = 0;
    double mean_difference = 0.0;  ///< over all channels of all pixels
    double share_over_threshold =
        0;  ///< of pixels with any channel further apart than the threshold
    /// The same, when each pixel may be compared with the best of the 3 x 3 around it in the other
    /// picture, both ways: edges that moved by one pixel (another machine, another library) do not
    /// count.
    double share_over_threshold_shifted = 0;
    /// Structural similarity of the grey pictures, mean over blocks of 8 x 8 (Wang et al. 2004): 1
    /// for equal pictures, near 0 for unrelated ones, -1 for opposites.
    double similarity = 1.0;
    double worst_similarity = 1.0;  ///< of the block that is least alike
};

/// Throws Error (differs) when the sizes differ. threshold: 0..255.
[[nodiscard]] ImageDifference compare_images(const Image& reference, const Image& other,
                                             int threshold = 8);

/// What two pictures may differ by and still count as equal. As it stands: by nothing.
struct ImageTolerance {
    int max_difference = 0;      ///< largest max_difference; 255: not asked
    double shifted_share = 0.0;  ///< largest share_over_threshold_shifted
    double similarity = -1.0;    ///< smallest similarity; -1: not asked
};

/// Which bounds are broken, one sentence each; empty: within the tolerance.
[[nodiscard]] std::vector<std::string> broken_bounds(const ImageDifference& difference,
                                                     const ImageTolerance& tolerance);

/// Why a picture shows nothing ("has one colour all over", "is black"), or "". Two pictures without
/// anything in them are equal, and say nothing about what was to be drawn.
[[nodiscard]] std::string blank_reason(const Image& image);

/// Reference, new and their difference (white: equal, darker: further apart) side by side, each
/// with its name above.
[[nodiscard]] Image difference_sheet(const Image& reference, const Image& other);
/// Height of the strip with the names, px.
inline constexpr int k_sheet_header_px = 40;
inline constexpr int k_sheet_gap_px = 8;  ///< between two pictures

}  // namespace spheroscope::render
