#include "render/layers/compose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

namespace spheroscope::render {

namespace {

/// Calls f(first, last) for shares of the rows 0..n_rows-1, each on a thread of its own.
template <class F> void on_rows(int n_rows, const F& f) {
    const int n_threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
    std::vector<std::jthread> others;
    for (int k = 1; k < n_threads; ++k)
        others.emplace_back([&f, k, n_threads, n_rows] {
            f(n_rows * k / n_threads, n_rows * (k + 1) / n_threads);
        });
    f(0, n_rows / n_threads);
}

/// How dark the crease line is at a drawn pixel, 0..1: from how much deeper the pixel lies than the
/// middle between its neighbours on opposite sides. A cell bulges towards the eye, so that only
/// gaps between cells and the far side of a silhouette are deeper than both sides.
class Creases {
  public:
    Creases(const Buffers& drawn, int reach_px, double px_per_um)
        : drawn_(drawn), reach_(reach_px),
          slope_per_depth_(static_cast<float>(drawn.depth_range_um * px_per_um / reach_px)) {}

    [[nodiscard]] float at(int x, int y) const {
        if (x < reach_ || y < reach_ || x >= drawn_.width - reach_ || y >= drawn_.height - reach_)
            return 0.0F;
        const std::ptrdiff_t row = drawn_.width;
        const float* here = drawn_.depth.data() + y * row + x;
        float deepest = 0.0F;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{reach_}, reach_ * row})
            deepest = std::max(deepest, *here - 0.5F * (here[step] + here[-step]));
        // Slopes below 0.15 are the facets of a mesh; from 0.8 on the line is full.
        constexpr float lowest = 0.15F, full = 0.8F;
        const float slope = deepest * slope_per_depth_;
        return std::clamp((slope - lowest) / (full - lowest), 0.0F, 1.0F);
    }

  private:
    const Buffers& drawn_;
    int reach_;
    float slope_per_depth_;
};

constexpr float k_crease_darkness = 0.62F;

}  // namespace

void add_network(Buffers& cells, const Buffers& network, double hidden_opacity) {
    const auto n_pixels = static_cast<std::ptrdiff_t>(cells.depth.size());
    for (std::ptrdiff_t i = 0; i < n_pixels; ++i) {
        const auto pixel = static_cast<std::size_t>(i);
        if (network.depth[pixel] >= 1.0F) continue;
        const bool before = network.depth[pixel] <= cells.depth[pixel];
        for (std::size_t k = 3 * pixel; k < 3 * pixel + 3; ++k) {
            const double share = before ? 1.0 : hidden_opacity;
            cells.rgb[k] = static_cast<std::uint8_t>(
                std::lround((1.0 - share) * cells.rgb[k] + share * network.rgb[k]));
        }
        if (before) cells.depth[pixel] = network.depth[pixel];
    }
}

Image make_image(const Buffers& drawn, int n_samples, double px_per_um) {
    Image image(drawn.width / n_samples, drawn.height / n_samples);
    // The line is one final pixel wide at 720 rows and grows with the picture.
    const int reach = std::max(1, static_cast<int>(std::lround(drawn.height / 720.0)));
    const Creases creases(drawn, reach, px_per_um);
    on_rows(image.height, [&](int first_row, int last_row) {
        for (int y = first_row; y < last_row; ++y)
            for (int x = 0; x < image.width; ++x) {
                std::array<float, 3> sum{};
                for (int sy = 0; sy < n_samples; ++sy)
                    for (int sx = 0; sx < n_samples; ++sx) {
                        const int drawn_x = x * n_samples + sx;
                        const int drawn_y = drawn.height - 1 - (y * n_samples + sy);
                        const float light = 1.0F - k_crease_darkness * creases.at(drawn_x, drawn_y);
                        const std::size_t i = 3 * (static_cast<std::size_t>(drawn_y) *
                                                       static_cast<std::size_t>(drawn.width) +
                                                   static_cast<std::size_t>(drawn_x));
                        for (std::size_t k = 0; k < 3; ++k)
                            sum[k] += light * static_cast<float>(drawn.rgb[i + k]);
                    }
                const float n = static_cast<float>(n_samples * n_samples);
                for (std::size_t k = 0; k < 3; ++k)
                    image.rgb[image.offset(x, y) + k] =
                        static_cast<std::uint8_t>(sum[k] / n + 0.5F);
            }
    });
    return image;
}

}  // namespace spheroscope::render
