#include "engine/run/expectations.hpp"

#include <algorithm>

namespace spheroscope {
namespace {

const TotalsRow& row_of(const scene::Expect& expect) {
    if (const TotalsRow* row = find_total(expect.measure)) return *row;
    std::string known;
    for (const TotalsRow& row : all_totals()) known += " " + std::string(row.name);
    throw Error(expect.loc, "[expect]: there is no measure '" + expect.measure + "'",
                "measures are:" + known);
}

}  // namespace

bool is_expected(const scene::Scene& scene, std::string_view measure) {
    return std::any_of(scene.expect.begin(), scene.expect.end(),
                       [&](const scene::Expect& expect) { return expect.measure == measure; });
}

void check_expectation_names(const scene::Scene& scene) {
    for (const scene::Expect& expect : scene.expect) static_cast<void>(row_of(expect));
}

std::vector<Expectation> check_expectations(const scene::Scene& scene, const Snapshot& last) {
    return check_expectations(scene, last.totals);
}

std::vector<Expectation> check_expectations(const scene::Scene& scene, const Totals& at_the_end) {
    std::vector<Expectation> rows;
    for (const scene::Expect& expect : scene.expect) {
        const TotalsRow& row = row_of(expect);
        const double value = value_of(row, at_the_end);
        rows.push_back({expect.measure, std::string(row.unit), value, expect.min, expect.max,
                        value >= expect.min && value <= expect.max});
    }
    return rows;
}

}  // namespace spheroscope
