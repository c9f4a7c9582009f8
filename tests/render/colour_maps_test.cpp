#include "render/colour_maps.hpp"
#include "render/layers/colouring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::render {
namespace {

double distance(const Oklab& p, const Oklab& q) {
    return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b);
}

/// What a deuteranope sees (Machado et al. 2009, severity 1), on linear light.
Rgb as_deuteranope_sees(Rgb c) {
    const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
    const double r = linear(c.r), g = linear(c.g), b = linear(c.b);
    const auto byte = [](double v) {
        return static_cast<std::uint8_t>(
            std::lround(255.0 * std::pow(std::max(v, 0.0), 1.0 / 2.2)));
    };
    return {byte(std::min(1.0, 0.367322 * r + 0.860646 * g - 0.227968 * b)),
            byte(std::min(1.0, 0.280085 * r + 0.672501 * g + 0.047413 * b)),
            byte(std::min(1.0, -0.011820 * r + 0.042940 * g + 0.968881 * b))};
}

TEST(ColourMap, EqualStepsOfTheValueAreEqualStepsForTheEye) {
    for (const ColourMap* map : {&ColourMap::diverging(), &ColourMap::sequential()}) {
        constexpr int n_steps = 16;  // long enough that rounding to bytes is small against a step
        std::array<double, n_steps> steps;
        double mean = 0.0;
        for (int k = 0; k < n_steps; ++k) {
            steps[static_cast<std::size_t>(k)] = distance(
                to_oklab(map->at(double(k) / n_steps)), to_oklab(map->at(double(k + 1) / n_steps)));
            mean += steps[static_cast<std::size_t>(k)] / n_steps;
        }
        // A step is 16 of 257 entries: rounding to an entry is 1/16, to bytes about 0.002 of 0.05.
        for (const double step : steps) EXPECT_NEAR(step, mean, 0.12 * mean);
    }
}

TEST(ColourMap, DivergingMapFallsInLightnessEquallyToBothSidesOfNearWhite) {
    const ColourMap& map = ColourMap::diverging();
    EXPECT_GT(to_oklab(map.at(0.5)).lightness, 0.95);
    for (int k = 0; k < 96; ++k) {
        const double t = 0.005 * k;
        EXPECT_LT(to_oklab(map.at(t)).lightness, to_oklab(map.at(t + 0.02)).lightness + 1e-3);
        EXPECT_NEAR(to_oklab(map.at(t)).lightness, to_oklab(map.at(1.0 - t)).lightness, 0.025);
    }
    EXPECT_GT(map.at(0.0).b, map.at(0.0).r) << "compression is blue";
    EXPECT_GT(map.at(1.0).r, map.at(1.0).b) << "tension is red";
}

TEST(ColourMap, SequentialMapRisesInLightnessEverywhere) {
    const ColourMap& map = ColourMap::sequential();
    for (int k = 0; k < 64; ++k)
        EXPECT_LT(to_oklab(map.at(k / 64.0)).lightness, to_oklab(map.at((k + 1) / 64.0)).lightness);
}

TEST(ColourMap, CompressionAndTensionStayApartWithoutGreenReceptors) {
    const ColourMap& map = ColourMap::diverging();
    for (const double strength : {0.25, 0.5, 0.75, 1.0}) {
        const Oklab blue = to_oklab(as_deuteranope_sees(map.at(0.5 - 0.5 * strength)));
        const Oklab red = to_oklab(as_deuteranope_sees(map.at(0.5 + 0.5 * strength)));
        EXPECT_GT(distance(blue, red), 0.15 * strength) << "0.02 is a just visible difference";
    }
}

TEST(ColourMap, EveryTenthOfAMapStaysApartWithoutGreenReceptors) {
    for (const ColourMap* map : {&ColourMap::diverging(), &ColourMap::sequential()})
        for (int i = 0; i <= 10; ++i)
            for (int k = 0; k < i; ++k) {
                const Oklab one = to_oklab(as_deuteranope_sees(map->at(i / 10.0)));
                const Oklab other = to_oklab(as_deuteranope_sees(map->at(k / 10.0)));
                EXPECT_GT(distance(one, other), 0.04)
                    << k << " and " << i << " tenths; 0.02 is a just visible difference";
            }
}

TEST(ColourMap, MarksAndTheGreyOfNothingStayApartFromTheMapWithoutGreenReceptors) {
    for (const ColourMap* map : {&ColourMap::diverging(), &ColourMap::sequential()})
        for (const Rgb mark : {map->below(), map->above(), k_absent_colour})
            for (int k = 0; k <= 256; ++k)
                EXPECT_GT(distance(to_oklab(as_deuteranope_sees(mark)),
                                   to_oklab(as_deuteranope_sees(map->at(k / 256.0)))),
                          0.03)
                    << k;
}

TEST(ColourMap, OfASignedFieldHasItsMiddleAtZeroInEveryRange) {
    using enum RangeKind;
    for (const Range range : {Range{-80.0, 80.0}, Range{-100.0, 300.0}, Range{-300.0, 20.0}}) {
        EXPECT_DOUBLE_EQ(map_position(signed_about_zero, range, 0.0), 0.5);
        const double half = std::max(-range.low, range.high);
        EXPECT_DOUBLE_EQ(map_position(signed_about_zero, range, 10.0), 0.5 + 5.0 / half);
        EXPECT_DOUBLE_EQ(map_position(signed_about_zero, range, -10.0), 0.5 - 5.0 / half)
            << "equal sizes have equal strength on both sides";
        EXPECT_LT(map_position(signed_about_zero, range, range.low - 1.0), 0.0);
        EXPECT_GT(map_position(signed_about_zero, range, range.high + 1.0), 1.0);
    }
    EXPECT_EQ(map_position(signed_about_zero, {-100.0, 300.0}, 300.0), 1.0);
    EXPECT_EQ(map_position(magnitude, {0.2, 0.6}, 0.2), 0.0);
    EXPECT_EQ(map_position(magnitude, {0.2, 0.6}, 0.6), 1.0);
    EXPECT_EQ(map_position(magnitude, {0.2, 0.6}, 0.6 + 1e-9), 1.0) << "float32 noise is inside";
}

TEST(ColourMap, MarksOfAbsentAndOutsideValuesAreColoursThatTheMapDoesNotHave) {
    for (const ColourMap* map : {&ColourMap::diverging(), &ColourMap::sequential()}) {
        EXPECT_EQ(map->at(-0.001), map->below());
        EXPECT_EQ(map->at(1.001), map->above());
        for (const Rgb mark : {map->below(), map->above(), k_absent_colour})
            for (int k = 0; k <= 256; ++k)
                EXPECT_GT(distance(to_oklab(mark), to_oklab(map->at(k / 256.0))), 0.07) << k;
    }
}

}  // namespace
}  // namespace spheroscope::render
