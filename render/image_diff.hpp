#pragma once

#include "render/image.hpp"

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
    /// for equal pictures, near 0 for unrelated ones.
    double similarity = 1.0;
};

/// Throws Error (usage) when the sizes differ. threshold: 0..255.
[[nodiscard]] ImageDifference compare_images(const Image& reference, const Image& other,
                                             int threshold = 8);

/// Reference, other and their difference (white: equal, darker: further apart) side by side.
[[nodiscard]] Image difference_sheet(const Image& reference, const Image& other);

}  // namespace spheroscope::render
