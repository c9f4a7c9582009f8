// Verdicts follow from numbers: each one of the paper's claims can come out both ways.
#include "engine/claims/verdict.hpp"
#include "engine/scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace spheroscope::claims {
namespace {

using statistics::SetupNumber;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

ClaimTable paper() { return load_claims(SPHEROSCOPE_SOURCE_DIR "/scenes/paper/paper.claims"); }

Claim claim(Range paper, double tolerance = 0.0) {
    Claim claim;
    claim.paper = paper;
    claim.tolerance = tolerance;
    return claim;
}

TEST(Judge, TakesTheLargerOfTwoErrorsAndTheTolerance) {
    const Range eighteen{18.0, 18.0};
    EXPECT_EQ(judge(claim(eighteen), {19.0, 0.51, 5}), Verdict::agrees);
    EXPECT_EQ(judge(claim(eighteen), {19.0, 0.49, 5}), Verdict::differs);
    EXPECT_EQ(judge(claim(eighteen, 1.5), {19.0, 0.1, 5}), Verdict::agrees);
    EXPECT_EQ(judge(claim(eighteen, 1.5), {19.6, 0.1, 5}), Verdict::differs);
    EXPECT_EQ(judge(claim(eighteen), {18.0, k_nan, 1}), Verdict::agrees);
    EXPECT_EQ(judge(claim(eighteen), {18.1, k_nan, 1}), Verdict::differs);
    EXPECT_EQ(judge(claim(eighteen), {k_nan, k_nan, 0}), Verdict::no_data);
}

TEST(Judge, GivesAOneSidedClaimNoGraceForItsErrors) {
    Range positive;
    positive.min = 0.0;
    EXPECT_EQ(judge(claim(positive), {0.1, 1.0, 5}), Verdict::agrees);
    EXPECT_EQ(judge(claim(positive), {-0.1, 1.0, 5}), Verdict::differs);
    EXPECT_EQ(judge(claim(positive, 0.2), {-0.1, 1.0, 5}), Verdict::agrees);
}

TEST(Judge, LeavesOpenWhatCannotBeDecided) {
    Claim open = claim({1.0, 1.0});
    open.undecidable = "the paper does not say of what";
    EXPECT_EQ(judge(open, {1.0, 0.1, 5}), Verdict::not_decidable);
}

MeasuredSetup measured(std::vector<SetupNumber> numbers,
                       std::vector<std::uint64_t> seeds = {1, 2}) {
    MeasuredSetup setup;
    setup.numbers = std::move(numbers);
    setup.n_cells = 150;
    for (const std::uint64_t seed : seeds) setup.runs.emplace_back().seed = seed;
    return setup;
}

SetupNumber number(const std::string& name, std::vector<double> by_run) {
    const statistics::Estimate estimate = statistics::mean_over_seeds(by_run);
    return {name, "1", estimate, std::move(by_run)};
}

TEST(JudgeClaims, ComparesNumbersOfOneSetupSeedBySeed) {
    const ClaimTable table = parse_claims(R"(
[[setup]]
name = "a"
scene = "a.toml"
seeds = [1, 2]
[[setup]]
name = "b"
scene = "b.toml"
seeds = [1, 2]
[[claim]]
id = "same"
source = "s"
says = "t"
setup = "a"
number = "x"
minus = { number = "y" }
above = 0
[[claim]]
id = "other"
source = "s"
says = "t"
setup = "a"
number = "x"
over = { setup = "b" }
factor = 10
is = 20
[[claim]]
id = "gone"
source = "s"
says = "t"
setup = "b"
number = "y"
above = 0
)",
                                          "t.claims");
    const MeasuredSetups setups{
        {"a", measured({number("x", {1.0, 3.0}), number("y", {0.5, 2.5})})},
        {"b", measured({number("x", {1.0, 1.0}), number("y", {k_nan, k_nan})})}};
    const auto judged = judge_claims(table, setups);
    EXPECT_EQ(judged[0].value.mean, 0.5);
    EXPECT_EQ(judged[0].value.standard_error, 0.0);
    EXPECT_EQ(judged[0].verdict, Verdict::agrees);
    EXPECT_EQ(judged[1].value.mean, 20.0);
    EXPECT_EQ(judged[1].value.standard_error, 10.0);
    EXPECT_EQ(judged[1].value.n, 2);
    EXPECT_TRUE(judged[1].reason.empty());
    EXPECT_EQ(judged[2].verdict, Verdict::no_data);
    EXPECT_NE(judged[2].reason.find("undefined"), std::string::npos);
    EXPECT_EQ(judge_claims(table, {})[0].verdict, Verdict::no_data);
    EXPECT_NE(claims_markdown(judged, setups).find("| 20 +- 10 |"), std::string::npos);
    EXPECT_EQ(claims_report(judged, setups).rows.size(), 3U);
    MeasuredSetups without = setups;
    without.at("a").numbers.pop_back();
    EXPECT_THROW(static_cast<void>(judge_claims(table, without)), Error);
}

TEST(JudgeClaims, SaysWhereAOneSidedClaimIsMetByLessThanItsError) {
    const ClaimTable table = parse_claims(R"(
[[setup]]
name = "a"
scene = "a.toml"
seeds = [1, 2]
[[claim]]
id = "positive"
source = "s"
says = "t"
setup = "a"
number = "x"
above = 0
)",
                                          "t.claims");
    const auto reason_of = [&](std::vector<double> x) {
        const auto judged = judge_claims(table, {{"a", measured({number("x", std::move(x))})}});
        EXPECT_EQ(judged[0].verdict, Verdict::agrees);
        return judged[0].reason;
    };
    EXPECT_EQ(reason_of({1.0, 1.1}), "");
    EXPECT_EQ(reason_of({-1.0, 1.1}), "by less than two standard errors");
}

TEST(JudgeClaims, ComparesSetupsByTheSeedsThatBothHave) {
    const ClaimTable table = parse_claims(R"(
[[setup]]
name = "long"
scene = "a.toml"
seeds = [1, 2, 3]
[[setup]]
name = "short"
scene = "b.toml"
seeds = [2, 3]
[[claim]]
id = "same"
source = "s"
says = "t"
setup = "short"
number = "x"
over = { setup = "long" }
is = 1
)",
                                          "t.claims");
    MeasuredSetups setups{{"long", measured({number("x", {9.0, 2.0, 4.0})}, {1, 2, 3})},
                          {"short", measured({number("x", {4.0, 2.0})}, {3, 2})}};
    // Seeds 2 and 3 have the same in both; the scatter from seed to seed is not an error.
    auto value = judge_claims(table, setups)[0].value;
    EXPECT_EQ(value.mean, 1.0);
    EXPECT_EQ(value.standard_error, 0.0);
    EXPECT_EQ(value.n, 2);
    // With another number of cells a seed packs them otherwise: the two means are compared.
    setups.at("short").n_cells = 75;
    value = judge_claims(table, setups)[0].value;
    EXPECT_EQ(value.mean, 3.0 / 5.0);
    EXPECT_GT(value.standard_error, 0.3);
    // As where no seed is in both.
    setups.at("short").n_cells = 150;
    for (MeasuredRun& run : setups.at("short").runs) run.seed += 10;
    EXPECT_EQ(judge_claims(table, setups)[0].value.mean, 3.0 / 5.0);
}

TEST(PaperClaims, HaveScenesThatLoad) {
    const ClaimTable table = paper();
    for (const ClaimedSetup& setup : table.setups) {
        if (setup.beads > 0) continue;
        std::vector<scene::Override> overrides;
        for (const std::string& text : setup.settings) {
            const auto equals = text.find('=');
            overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
        }
        EXPECT_NO_THROW(static_cast<void>(scene::load_scene(table.scene_path(setup), overrides)))
            << setup.name;
    }
}

TEST(PaperClaims, AskForNumbersThatThereAre) {
    statistics::SetupStatistics none;
    none.runs.emplace_back();
    none.runs.front().setup.law = "traction";
    none.runs.front().equal_kPa.assign(1, {});
    none.runs.front().area_kPa.assign(1, {});
    MeasuredSetups measured_setups;
    const ClaimTable table = paper();
    for (const ClaimedSetup& setup : table.setups) {
        measured_setups[setup.name] = setup.beads > 0
                                          ? measured({number("jamming_fraction", {0.64}),
                                                      number("coordination_at_jamming", {6.0}),
                                                      number("coordination_exponent", {0.5})})
                                          : measured(statistics::numbers_of(none));
    }
    EXPECT_NO_THROW(static_cast<void>(judge_claims(table, measured_setups)));
}

/// The verdict on one claim where the compared number, x, x - 0 or x / 1, has this mean and error
/// in the claim's unit.
Verdict verdict_on(const ClaimTable& table, const Claim& claim, double mean, double error) {
    MeasuredSetups setups;
    const auto add = [&](const Quantity& quantity, double value, double value_error) {
        MeasuredSetup& setup = setups[quantity.setup];
        setup.runs.resize(2);
        setup.runs[0].seed = 1;
        setup.runs[1].seed = 2;
        // the standard error of two values is half their distance
        setup.numbers.push_back(
            number(quantity.number, {value - value_error, value + value_error}));
    };
    add(claim.measured, mean / claim.factor, error / claim.factor);
    if (claim.minus) add(*claim.minus, 0.0, 0.0);
    if (claim.over) add(*claim.over, 1.0, 0.0);
    ClaimTable one = table;
    one.claims = {claim};
    return judge_claims(one, setups).front().verdict;
}

/// Each claim with numbers that meet it, and with numbers that do not, on each side that it has,
/// and with errors that are too small and large enough to make up for the distance.
TEST(PaperClaims, EachVerdictFlipsWithItsNumber) {
    const ClaimTable table = paper();
    for (const Claim& claim : table.claims) {
        if (!claim.undecidable.empty()) continue;
        SCOPED_TRACE(claim.id);
        const Range accepted = claim.accepted();
        for (const int side : {-1, 1}) {
            const double bound = side < 0 ? accepted.min : accepted.max;
            const double end = side < 0 ? claim.paper.min : claim.paper.max;
            if (std::isinf(bound)) continue;
            const double step = 1e-3 * std::max(1.0, std::abs(bound));
            const double outside = bound + side * step;
            const double distance = std::abs(outside - end);
            EXPECT_EQ(verdict_on(table, claim, end - side * 1e-9, 0.0), Verdict::agrees);
            EXPECT_EQ(verdict_on(table, claim, outside, 0.0), Verdict::differs);
            EXPECT_EQ(verdict_on(table, claim, outside, 0.4 * distance), Verdict::differs);
            EXPECT_EQ(verdict_on(table, claim, outside, 0.6 * distance),
                      claim.paper.is_one_sided() ? Verdict::differs : Verdict::agrees);
        }
    }
}

MeasuredSetup ended(const std::vector<std::string>& outcomes) {
    MeasuredSetup setup = measured({number("x", std::vector<double>(outcomes.size(), 1.0))}, {});
    for (const std::string& outcome : outcomes) {
        MeasuredRun& run = setup.runs.emplace_back();
        run.seed = setup.runs.size();
        run.outcome = outcome;
        run.totals = Totals{};
        run.last_dt_s = 0.5 * static_cast<double>(run.seed);
    }
    return setup;
}

TEST(EndsOfRuns, CountThoseAtRestAndAllFlippedTriangles) {
    MeasuredSetup setup = ended({"rest", "cap", "rest"});
    EXPECT_EQ(ends_text(setup), "rest 2 of 3, flips 0, last dt 0.5 ... 1.5 s");
    setup.runs[0].totals->n_flipped_triangles = 2;
    setup.runs[1].totals->n_flipped_triangles = 1;
    setup.runs[2].totals->normal_speed_rms_um_per_s = 2e-3;
    EXPECT_EQ(ends_text(setup), "rest 1 of 3, flips 3, last dt 0.5 ... 1.5 s")
        << "what moves is not at rest, whatever it is called";
    EXPECT_EQ(remark_on_motion(setup).find("seed 3 (rest): nodes still move with 0.002 um/s"), 0U);
    setup.runs[1].missing_counts = {"n_flipped_triangles"};
    EXPECT_EQ(ends_text(setup), "rest 1 of 3, flips unknown, last dt 0.5 ... 1.5 s");
    MeasuredSetup beads = measured({number("jamming_fraction", {0.64, 0.64})});
    EXPECT_EQ(ends_text(beads), "");
    EXPECT_EQ(remark_on_motion(beads), "");
}

TEST(ClaimsReport, SaysOfEachRowWhenItWasWrittenAndHowItsRunsEnded) {
    const ClaimTable table = parse_claims(R"(
[[setup]]
name = "a"
scene = "a.toml"
seeds = [1, 2]
[[setup]]
name = "b"
scene = "b.toml"
seeds = [1]
[[claim]]
id = "of_one"
source = "s"
says = "t"
setup = "a"
number = "x"
is = 1
[[claim]]
id = "of_two"
written = "after"
source = "s"
says = "t"
setup = "a"
number = "x"
over = { setup = "b" }
is = 1
)",
                                          "t.claims");
    const MeasuredSetups setups{{"a", ended({"rest", "cap"})}, {"b", ended({"rest"})}};
    const auto judged = judge_claims(table, setups);
    const std::string of_a = "rest 1 of 2, flips 0, last dt 0.5 ... 1 s",
                      of_both = "a: " + of_a + "; b: rest 1 of 1, flips 0, last dt 0.5 s";
    const std::string page = claims_markdown(judged, setups);
    for (const std::string& part :
         {"| before | 1 +- 0 | 2 | " + of_a + " |", "| after | 1 | 1 | " + of_both + " |"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
    const std::string file = claims_report(judged, setups).csv_text({});
    for (const std::string& part : {",before,1,0,2,\"" + of_a + "\",", std::string(",after,1,")})
        EXPECT_NE(file.find(part), std::string::npos) << part << "\n" << file;
    EXPECT_NE(file.find("\"" + of_both + "\""), std::string::npos) << file;
}

TEST(JudgeClaims, SaysWhatAKeptReportDoesNotHave) {
    const ClaimTable table = parse_claims(R"(
[[setup]]
name = "a"
scene = "a.toml"
seeds = [1, 2]
[[setup]]
name = "b"
scene = "b.toml"
seeds = [1, 2]
[[claim]]
id = "new"
source = "s"
says = "t"
setup = "a"
number = "y"
minus = { setup = "b" }
remark = "of new cells"
between = [1, 2]
tolerance_factor = 2
)",
                                          "t.claims");
    MeasuredSetups setups{{"a", measured({number("x", {1.0, 3.0})})},
                          {"b", measured({number("y", {1.0, 3.0})})}};
    EXPECT_THROW(static_cast<void>(judge_claims(table, setups)), Error);
    setups.at("a").is_kept = true;
    const auto judged = judge_claims(table, setups);
    EXPECT_EQ(judged[0].verdict, Verdict::no_data);
    EXPECT_EQ(judged[0].reason, "the report that a is kept from does not have 'y'");
    EXPECT_EQ(command_of(paper().claims.front()), "spheroscope reproduce --full --only case_a");
    EXPECT_EQ(command_of(table.claims[0]),
              "spheroscope reproduce t.claims --full --only a --only b");
    const std::string page = claims_markdown(judged, setups);
    for (const char* part :
         {"(of new cells)", "| factor 2 |", "`spheroscope reproduce t.claims --full"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    const std::string file = claims_report(judged, setups).csv_text({});
    for (const char* part : {"of new cells", "factor 2", "spheroscope reproduce t.claims --full"})
        EXPECT_NE(file.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace spheroscope::claims
