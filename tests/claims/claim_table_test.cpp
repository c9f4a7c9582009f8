// The file of claims: what it may say, and what its mistakes are called.
#include "engine/claims/claim_table.hpp"

#include <gtest/gtest.h>

#include <string>

namespace spheroscope::claims {
namespace {

const std::string k_setups = R"(
[[setup]]
name = "a"
scene = "case_a.toml"
set = ["cells.nodes=162"]
seeds = [1, 2, 3]
quick_seeds = [1]
[[setup]]
name = "b"
scene = "case_b.toml"
seeds = [1]
)";

std::string claim(const std::string& rest) {
    return k_setups + "[[claim]]\nid = \"x\"\nsource = \"Fig. 2\"\nsays = \"it is so\"\n" + rest;
}

std::string error_of(const std::string& text) {
    try {
        static_cast<void>(parse_claims(text, "my.claims"));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ClaimTable, ReadsSetupsAndClaims) {
    const ClaimTable table = parse_claims(
        claim("setup = \"a\"\nnumber = \"energy\"\nminus = { setup = \"b\" }\nfactor = 2\n"
              "unit = \"fJ\"\nbetween = [1, 2]\ntolerance = 0.5\n"),
        "scenes/my.claims");
    ASSERT_EQ(table.setups.size(), 2U);
    EXPECT_EQ(table.setups[0].seeds, (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_EQ(table.setups[0].quick_seeds, (std::vector<std::uint64_t>{1}));
    EXPECT_TRUE(table.setups[1].quick_seeds.empty());
    EXPECT_EQ(table.scene_path(table.setups[0]), "scenes/case_a.toml");
    ASSERT_EQ(table.claims.size(), 1U);
    const Claim& row = table.claims[0];
    EXPECT_EQ(row.measured.number, "energy");
    EXPECT_EQ(row.minus->setup, "b");
    EXPECT_EQ(row.minus->number, "energy");
    EXPECT_EQ(row.factor, 2.0);
    EXPECT_EQ(row.paper.text(), "1 ... 2");
    EXPECT_EQ(row.paper.distance(0.5), 0.5);
    EXPECT_EQ(row.paper.distance(1.5), 0.0);
    EXPECT_EQ(row.paper.distance(4.0), 2.0);
}

TEST(ClaimTable, MakesARowForEachSetupOfAList) {
    const ClaimTable table = parse_claims(
        claim("setup = [\"a\", \"b\"]\nnumber = \"x\"\nminus = { number = \"y\" }\nabove = 0\n"),
        "my.claims");
    ASSERT_EQ(table.claims.size(), 2U);
    EXPECT_EQ(table.claims[1].id, "x/b");
    EXPECT_EQ(table.claims[1].minus->setup, "b");
    EXPECT_TRUE(table.claims[1].paper.is_one_sided());
}

TEST(ClaimTable, HasATolerancePerClaimThatIsADifferenceOrAFactor) {
    const auto first = [](const std::string& keys) {
        return parse_claims(claim("setup = \"a\"\nnumber = \"x\"\n" + keys), "my.claims")
            .claims.front();
    };
    const Claim exact = first("is = 3\n");
    EXPECT_EQ(exact.accepted().min, 3.0);
    EXPECT_EQ(exact.accepted().max, 3.0);
    EXPECT_EQ(exact.tolerance_text(), "");
    EXPECT_EQ(exact.remark, "");
    const Claim near = first("between = [2, 3]\ntolerance = 0.5\nremark = \"r\"\n");
    EXPECT_EQ(near.accepted().min, 1.5);
    EXPECT_EQ(near.accepted().max, 3.5);
    EXPECT_EQ(near.tolerance_text(), "0.5");
    EXPECT_EQ(near.remark, "r");
    const Claim twice = first("between = [2, 3]\ntolerance_factor = 2\n");
    EXPECT_EQ(twice.accepted().min, 1.0);
    EXPECT_EQ(twice.accepted().max, 6.0);
    EXPECT_EQ(twice.tolerance_text(), "factor 2");
    const Claim tenfold = first("is = -358\ntolerance_factor = 10\n");
    EXPECT_EQ(tenfold.accepted().min, -3580.0);
    EXPECT_EQ(tenfold.accepted().max, -35.8);
}

TEST(ClaimTable, SaysWhichClaimsWereWrittenAfterTheRuns) {
    const auto written = [](const std::string& key) {
        return parse_claims(claim("setup = \"a\"\nnumber = \"x\"\nis = 3\n" + key), "my.claims")
            .claims.front()
            .written;
    };
    EXPECT_EQ(written(""), Written::before);
    EXPECT_EQ(written("written = \"before\"\n"), Written::before);
    EXPECT_EQ(written("written = \"after\"\n"), Written::after);
    // each row of a claim with several setups
    for (const Claim& row :
         parse_claims(
             claim("setup = [\"a\", \"b\"]\nnumber = \"x\"\nis = 3\nwritten = \"after\"\n"),
             "my.claims")
             .claims)
        EXPECT_EQ(row.written, Written::after) << row.id;
}

TEST(ClaimTable, NamesThePlaceOfAMistake) {
    const std::string good = "setup = \"a\"\nnumber = \"x\"\n";
    const std::pair<std::string, std::string> mistakes[]{
        {claim(good), "a claim wants one of is, above, below, between; got 0"},
        {claim(good + "is = 1\nabove = 0\n"), "got 2"},
        {claim(good + "between = [2, 1]\n"), "the smaller number first"},
        {claim(good + "is = \"many\"\n"), "my.claims:18:6: error: 'is' wants a number"},
        {claim(good + "is = 1\ntolerance = -1\n"), "a number from 0"},
        {claim(good + "is = 1\nwritten = \"later\"\n"),
         "my.claims:19:11: error: 'written' wants \"before\" or \"after\" (the runs), got "},
        {claim(good + "is = 1\nwritten = true\n"), "'written' wants \"before\" or \"after\""},
        {claim(good + "is = 1\ntolerance_factor = 0.5\n"), "a number from 1"},
        {claim(good + "is = 1\ntolerance = 1\ntolerance_factor = 2\n"), "got both"},
        {claim(good + "between = [-1, 1]\ntolerance_factor = 2\n"), "on one side of zero"},
        {claim(good + "above = 1\ntolerance_factor = 2\n"), "with both ends"},
        {claim(good + "is = 1\ntolerence = 1\n"),
         "my.claims:19:1: error: a claim has no key 'tolerence'"},
        {claim("setup = \"c\"\nnumber = \"x\"\nis = 1\n"), "there is no setup 'c'"},
        {claim("number = \"x\"\nis = 1\n"), "a claim has no 'setup'"},
        {claim(good + "is = 1\nminus = { setup = \"c\" }\n"), "there is no setup 'c'"},
        {claim(good + "is = 1\nminus = { setup = \"a\" }\n"), "the measured number itself"},
        {claim(good + "is = 1\nminus = { number = \"y\" }\nover = { number = \"y\" }\n"),
         "got both"},
        {k_setups, "there is no [[claim]]"},
        {claim(good + "is = 1\n") + k_setups, "two setups 'a'"},
        {"[[setup]]\nname = \"a\"\nscene = \"b\"\nseeds = [1, 1]\n", "each seed once"},
        {"[[setup]]\nname = \"a\"\nscene = \"b\"\n", "has no seeds"},
        {"[[setup]]\nname = \"a\"\nseeds = [1]\n", "either a scene or a number of beads"},
        {"[[setup]]\nname = \"a\"\nscene = \"b\"\nbeads = 500\nseeds = [1]\n",
         "either a scene or a number of beads"},
        {"[[setup]]\nname = \"a\"\nbeads = 5\nseeds = [1]\n", "from 100 to 100000"},
        {"[[setup]]\nname = \"a\"\nbeads = 500\nset = [\"b=1\"]\nseeds = [1]\n", "nothing to set"},
        {"[figure]\n", "my.claims:1:1: error: a file of claims has no 'figure'"},
    };
    for (const auto& [text, message] : mistakes)
        EXPECT_NE(error_of(text).find(message), std::string::npos)
            << error_of(text) << "\nis not: " << message;
}

TEST(ClaimTable, HasFewClaimsThatNothingCanDecide) {
    std::string text = k_setups;
    for (int i = 0; i < 4; ++i)
        text += "[[claim]]\nid = \"x" + std::to_string(i) +
                "\"\nsource = \"s\"\nsays = \"t\"\nsetup = \"a\"\nnumber = \"x\"\nis = 1\n"
                "undecidable = \"because\"\n";
    EXPECT_NE(error_of(text).find("more than 3"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::claims
