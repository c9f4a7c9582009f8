#include "engine/scene/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace spheroscope::scene {
namespace {

double value_of(const char* text, Dimension dimension) {
    const Quantity quantity = parse_quantity(text, dimension);
    EXPECT_TRUE(quantity.ok()) << text << " " << quantity.problem;
    return quantity.value;
}

std::string problem_of(const char* text, Dimension dimension) {
    return parse_quantity(text, dimension).problem;
}

TEST(Units, PowersOfTenMoveTheDecimalPointAndRoundOnce) {
    // each right side is the double nearest to the decimal number, as the compiler reads it
    EXPECT_EQ(value_of("20 kPa", Dimension::stiffness), 20.0);
    EXPECT_EQ(value_of("200 nm", Dimension::length), 0.2);
    EXPECT_EQ(value_of("3.85 ms", Dimension::time), 0.00385);
    EXPECT_EQ(value_of("312.5 Pa", Dimension::pressure), 0.3125);
    EXPECT_EQ(value_of("0.3e-3 mm", Dimension::length), 0.3);
    EXPECT_EQ(value_of("1 %", Dimension::number), 0.01);
    EXPECT_EQ(value_of("7 us", Dimension::time), 7e-6);
    // 123.456 * 0.001 is another double than 0.123456
    ASSERT_NE(123.456 * 0.001, 0.123456);
    EXPECT_EQ(value_of("123.456 nm", Dimension::length), 0.123456);
}

TEST(Units, ProductsAndQuotientsOfUnitsReachTheEngineUnit) {
    EXPECT_EQ(value_of("0.5 nN/um", Dimension::tension), 0.5);
    EXPECT_EQ(value_of("0.5 mN/m", Dimension::tension), 0.5);
    EXPECT_EQ(value_of("0.5 mJ/m^2", Dimension::tension), 0.5);
    EXPECT_EQ(value_of("1 kPa s", Dimension::viscosity), 1.0);
    EXPECT_EQ(value_of("1 kPa*s", Dimension::viscosity), 1.0);
    EXPECT_EQ(value_of("50 Pa s", Dimension::viscosity), 0.05);
    EXPECT_EQ(value_of("0.05 kPa s/um", Dimension::friction_per_area), 0.05);
    EXPECT_EQ(value_of("0.05 nN s um^-3", Dimension::friction_per_area), 0.05);
    EXPECT_EQ(value_of("2 nN/um^2", Dimension::stiffness), 2.0);
    EXPECT_EQ(value_of("0.5 1/s", Dimension::rate), 0.5);
    EXPECT_EQ(value_of("0.5/s", Dimension::rate), 0.5);
    EXPECT_EQ(value_of("2 min", Dimension::time), 120.0);
}

TEST(Units, MicroSignsAndRaisedDigitsAreRead) {
    EXPECT_EQ(value_of("9 \u00b5m", Dimension::length), 9.0);
    EXPECT_EQ(value_of("9 \u03bcm", Dimension::length), 9.0);
    EXPECT_EQ(value_of("3 \u00b5m\u00b2", Dimension::area), 3.0);
}

TEST(Units, AnglesTurnIntoTheUnitOfTheirKey) {
    EXPECT_EQ(value_of("90 deg", Dimension::angle), std::numbers::pi / 2.0);
    EXPECT_EQ(value_of("1.5 rad", Dimension::angle), 1.5);
    EXPECT_EQ(value_of("30 deg", Dimension::view_angle), 30.0);
    EXPECT_NEAR(value_of("3.141592653589793 rad", Dimension::view_angle), 180.0, 1e-12);
}

TEST(Units, WhatWasGotIsNamedByItsDimension) {
    EXPECT_EQ(problem_of("20 nN/um", Dimension::stiffness), "(a tension)");
    EXPECT_EQ(problem_of("20 kPa", Dimension::tension), "(a stiffness or a pressure)");
    EXPECT_EQ(problem_of("20", Dimension::tension), "(no unit)");
    EXPECT_EQ(problem_of("20 um^5", Dimension::tension), "(nothing that a scene has a key for)");
    EXPECT_EQ(problem_of("20 kPaa", Dimension::stiffness), "(unknown unit 'kPaa')");
    EXPECT_EQ(problem_of("20 kPa/", Dimension::stiffness), "(unknown unit '/')");
    EXPECT_EQ(problem_of("20 kPa//s", Dimension::stiffness), "(unknown unit '/')");
    EXPECT_EQ(problem_of("20 um^", Dimension::length), "(unknown unit 'um^')");
    EXPECT_EQ(problem_of("kPa", Dimension::stiffness), "(no number)");
    EXPECT_EQ(problem_of("", Dimension::stiffness), "(no number)");
    EXPECT_EQ(problem_of("inf um", Dimension::length), "(no number)");
    EXPECT_EQ(problem_of("1e400 um", Dimension::length), "(too large)");
    EXPECT_EQ(problem_of("1e99999999999 um", Dimension::length), "(too large)");
}

TEST(Units, WrittenQuantitiesReadBackToTheSameBits) {
    for (const double value : {0.1 + 0.2, 1.0 / 3.0, 20.0, 1e-6, 1.1547005383792517, 6.02e23}) {
        for (const Dimension dimension :
             {Dimension::number, Dimension::length, Dimension::rate, Dimension::angle,
              Dimension::view_angle, Dimension::friction_per_area, Dimension::tension}) {
            const std::string text = format_quantity(value, dimension);
            EXPECT_EQ(value_of(text.c_str(), dimension), value) << text;
        }
    }
}

}  // namespace
}  // namespace spheroscope::scene
