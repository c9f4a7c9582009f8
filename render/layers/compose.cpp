#include "render/layers/compose.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <thread>
#include <vector>

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

constexpr float k_crease_darkness = 0.62F;

/// How much light the crease lines leave a drawn pixel, 0..1, a row at a time. A pixel is on such a
/// line as far as it lies deeper than the middle between its neighbours on opposite sides: a cell
/// bulges towards the eye, so that only gaps between cells and the far side of a silhouette are
/// deeper than both sides.
class Creases {
  public:
    Creases(const Buffers& drawn, int reach_px, double px_per_um)
        : drawn_(drawn), reach_(reach_px),
          slope_per_depth_(static_cast<float>(drawn.depth_range_um * px_per_um / reach_px)) {}

    /// light: one for each pixel of the row.
    void light_of_row(int y, std::vector<float>& light) const {
        std::fill(light.begin(), light.end(), 1.0F);
        if (y < reach_ || y >= drawn_.height - reach_) return;
        const std::ptrdiff_t width = drawn_.width, reach = reach_;
        const float* const row = drawn_.depth.data() + y * width;
        const float *const above = row - reach * width, *const below = row + reach * width;
        // Slopes below 0.15 are the facets of a mesh; from 0.8 on the line is full.
        constexpr float lowest = 0.15F, full = 0.8F;
        float* const out = light.data();
        const float slope_per_depth = slope_per_depth_;
        // no branch: the compiler makes SIMD of it
        for (std::ptrdiff_t x = reach; x < width - reach; ++x) {
            const float across = row[x] - 0.5F * (row[x + reach] + row[x - reach]);
            const float along = row[x] - 0.5F * (below[x] + above[x]);
            const float slope = std::max(std::max(0.0F, across), along) * slope_per_depth;
            const float share = std::min(std::max((slope - lowest) / (full - lowest), 0.0F), 1.0F);
            out[x] = 1.0F - k_crease_darkness * share;
        }
    }

  private:
    const Buffers& drawn_;
    int reach_;
    float slope_per_depth_;
};

constexpr int k_most_samples = 2;  // drawn pixels along each side of a final one

/// Where a row of drawn pixels is being read.
struct Samples {
    const std::uint8_t* rgba;
    const float* light;
};

/// Averages n x n lit pixels into one, and moves on.
template <int n> void average(std::array<Samples, k_most_samples>& rows, std::uint8_t* pixel) {
    // Most pixels are on no line. Their sums of bytes stay apart in halves of 32-bit words; the
    // result is what the sums of floats below give, because those are exact for whole numbers.
    bool is_lit = true;
    std::uint32_t red_and_blue = 0, green = 0;
    for (int sy = 0; sy < n; ++sy)
        for (int sx = 0; sx < n; ++sx) {
            std::uint32_t word = 0;
            std::memcpy(&word, rows[static_cast<std::size_t>(sy)].rgba + 4 * sx, 4);
            red_and_blue += word & 0x00FF00FFU;
            green += (word >> 8U) & 0xFFU;
            is_lit = is_lit && rows[static_cast<std::size_t>(sy)].light[sx] == 1.0F;
        }
    if (is_lit) {
        constexpr unsigned shift = n == 1 ? 0U : 2U;
        static_assert(1U << shift == n * n);
        constexpr std::uint32_t half = n * n / 2;
        red_and_blue += half | (half << 16U);
        pixel[0] = static_cast<std::uint8_t>((red_and_blue & 0xFFFFU) >> shift);
        pixel[1] = static_cast<std::uint8_t>((green + half) >> shift);
        pixel[2] = static_cast<std::uint8_t>(red_and_blue >> (16U + shift));
    } else {
        for (int k = 0; k < 3; ++k) {
            float sum = 0.0F;
            for (int sy = 0; sy < n; ++sy)
                for (int sx = 0; sx < n; ++sx)
                    sum += rows[static_cast<std::size_t>(sy)].light[sx] *
                           static_cast<float>(rows[static_cast<std::size_t>(sy)].rgba[4 * sx + k]);
            pixel[k] = static_cast<std::uint8_t>(sum / static_cast<float>(n * n) + 0.5F);
        }
    }
    for (int sy = 0; sy < n; ++sy) {
        rows[static_cast<std::size_t>(sy)].rgba += std::ptrdiff_t{4} * n;
        rows[static_cast<std::size_t>(sy)].light += n;
    }
}

}  // namespace

void add_network(Buffers& cells, const Buffers& network, double hidden_opacity) {
    const auto n_pixels = static_cast<std::ptrdiff_t>(cells.depth.size());
    for (std::ptrdiff_t i = 0; i < n_pixels; ++i) {
        const auto pixel = static_cast<std::size_t>(i);
        if (network.depth[pixel] >= 1.0F) continue;
        const bool before = network.depth[pixel] <= cells.depth[pixel];
        for (std::size_t k = 4 * pixel; k < 4 * pixel + 3; ++k) {
            const double share = before ? 1.0 : hidden_opacity;
            cells.rgba[k] = static_cast<std::uint8_t>(
                std::lround((1.0 - share) * cells.rgba[k] + share * network.rgba[k]));
        }
        if (before) cells.depth[pixel] = network.depth[pixel];
    }
}

void add_glass(Buffers& cells, const Buffers& glass, double opacity) {
    for (std::size_t pixel = 0; pixel < cells.depth.size(); ++pixel) {
        if (glass.depth[pixel] >= 1.0F || glass.depth[pixel] > cells.depth[pixel]) continue;
        for (std::size_t k = 4 * pixel; k < 4 * pixel + 3; ++k)
            cells.rgba[k] = static_cast<std::uint8_t>(
                std::lround((1.0 - opacity) * cells.rgba[k] + opacity * glass.rgba[k]));
    }
}

Image make_image(const Buffers& drawn, int n_samples, double px_per_um) {
    static_assert(std::endian::native == std::endian::little, "average() reads words of bytes");
    SPHEROSCOPE_ASSERT(n_samples >= 1 && n_samples <= k_most_samples, "one pixel, or 2 x 2");
    Image image(drawn.width / n_samples, drawn.height / n_samples);
    // The line is one final pixel wide at 720 rows and grows with the picture.
    const int reach = std::max(1, static_cast<int>(std::lround(drawn.height / 720.0)));
    const Creases creases(drawn, reach, px_per_um);
    on_rows(image.height, [&](int first_row, int last_row) {
        const auto width = static_cast<std::size_t>(drawn.width);
        std::vector<std::vector<float>> light(static_cast<std::size_t>(n_samples),
                                              std::vector<float>(width));
        for (int y = first_row; y < last_row; ++y) {
            std::array<Samples, k_most_samples> rows{};
            for (int sy = 0; sy < n_samples; ++sy) {
                const int drawn_y = drawn.height - 1 - (y * n_samples + sy);
                std::vector<float>& lit = light[static_cast<std::size_t>(sy)];
                creases.light_of_row(drawn_y, lit);
                rows[static_cast<std::size_t>(sy)] = {
                    drawn.rgba.data() + 4 * static_cast<std::size_t>(drawn_y) * width, lit.data()};
            }
            std::uint8_t* pixel = image.rgb.data() + image.offset(0, y);
            if (n_samples == 1)
                for (int x = 0; x < image.width; ++x, pixel += 3) average<1>(rows, pixel);
            else
                for (int x = 0; x < image.width; ++x, pixel += 3) average<2>(rows, pixel);
        }
    });
    return image;
}

}  // namespace spheroscope::render
