#pragma once

#include "engine/measures/fields.hpp"
#include "render/image.hpp"

#include <array>

namespace spheroscope::render {

/// For lines and arrows: told apart with all kinds of colour vision (Okabe and Ito 2008).
inline constexpr std::array<Rgb, 7> k_distinct_colours{{{0, 114, 178},
                                                        {213, 94, 0},
                                                        {0, 158, 115},
                                                        {204, 121, 167},
                                                        {86, 180, 233},
                                                        {230, 159, 0},
                                                        {60, 60, 60}}};

/// A table of colours from the low end of a range to its high end, with one colour for each side
/// outside. Both maps are curves in the Oklab colour space (Ottosson 2020), cut into steps of equal
/// length there, so that equal steps of the value look equal.
class ColourMap {
  public:
    static constexpr int k_size = 257;  ///< odd: the middle of the diverging map is an entry

    /// Blue - near white - red, lightness falling equally to both sides: red and blue stay apart
    /// for every common colour blindness, and the amount can be read from the lightness alone.
    [[nodiscard]] static const ColourMap& diverging();
    /// Dark violet - blue - green - yellow, lightness rising steadily.
    [[nodiscard]] static const ColourMap& sequential();
    /// The map for a kind of field.
    [[nodiscard]] static const ColourMap& of(RangeKind kind);

    /// Colour of t in 0..1; `below` or `above` outside. t must not be NaN.
    [[nodiscard]] Rgb at(double t) const;
    [[nodiscard]] Rgb below() const { return below_; }
    [[nodiscard]] Rgb above() const { return above_; }

  private:
    ColourMap(std::array<Rgb, k_size> table, Rgb below, Rgb above)
        : table_(table), below_(below), above_(above) {}

    std::array<Rgb, k_size> table_;
    Rgb below_, above_;
};

/// Colour of 'nothing to measure here': a neutral grey, darker than the near-white of zero stress.
inline constexpr Rgb k_absent_colour{180, 182, 186};

/// A colour in Oklab: lightness 0..1 and the two opponent axes.
struct Oklab {
    double lightness, a, b;
};
[[nodiscard]] Oklab to_oklab(Rgb colour);
/// Nearest 8-bit colour. Precondition: the colour can be shown (lies inside sRGB to a bit or so).
[[nodiscard]] Rgb from_oklab(const Oklab& colour);

}  // namespace spheroscope::render
