#include "engine/run/changes.hpp"

#include "engine/scene/limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace spheroscope {
namespace {

using scene::Scene;

bool has_omega(const Scene& s) {
    return s.contact && s.contact->adhesive && s.contact->omega_nN_per_um > 0.0;
}
bool has_W_alone(const Scene& s) {
    return s.contact && s.contact->adhesive && !(s.contact->omega_nN_per_um > 0.0);
}

std::size_t n_values(const ChangeableRow& row) {
    return row.of == ChangeableRow::Of::picture ? 2 : 1;
}

void check_values(const ChangeableRow& row, const Change& change) {
    const auto& values = change.values;
    const std::size_t n_wanted = n_values(row);
    if (values.size() != n_wanted)
        throw Error(fmt::format("{} wants {} number{}, got {}", change.key, n_wanted,
                                n_wanted == 1 ? "" : "s", values.size()));
    const std::string problem = row.of == ChangeableRow::Of::picture
                                    ? scene::problem_of_range({values[0], values[1]})
                                    : scene::problem_of_number(change.key, values[0]);
    if (!problem.empty()) throw Error(problem);
}

}  // namespace

std::span<const ChangeableRow> all_changeable() {
    using scene::Dimension;
    using enum ChangeableRow::Of;
    using Values = std::vector<double>;
    using Given = std::span<const double>;
    static constexpr std::array<ChangeableRow, 5> rows{{
        {"cortex.tension.gamma", "γ", Dimension::tension, engine,
         [](const Scene& s) { return s.cortex.tension.has_value(); },
         [](const Scene& s) { return Values{s.cortex.tension->gamma_nN_per_um}; },
         [](Scene& s, Given v) { s.cortex.tension->gamma_nN_per_um = v[0]; }},
        {"contact.adhesion.omega", "ω", Dimension::tension, engine, has_omega,
         [](const Scene& s) { return Values{s.contact->omega_nN_per_um}; },
         [](Scene& s, Given v) {
             // the reading of omega stays what it is
             s.contact->W_nN_per_um *= v[0] / s.contact->omega_nN_per_um;
             s.contact->omega_nN_per_um = v[0];
         }},
        {"contact.adhesion.W", "W", Dimension::tension, engine, has_W_alone,
         [](const Scene& s) { return Values{s.contact->W_nN_per_um}; },
         [](Scene& s, Given v) { s.contact->W_nN_per_um = v[0]; }},
        {"method.tolerance", "step tolerance", Dimension::length, engine,
         [](const Scene& s) { return s.method.tolerance_um > 0.0; },
         [](const Scene& s) { return Values{s.method.tolerance_um}; },
         [](Scene& s, Given v) { s.method.tolerance_um = v[0]; }},
        {"picture.given_range", "colours", Dimension::number, picture,
         [](const Scene& s) { return !s.pictures.empty(); },
         [](const Scene& s) {
             const auto& range = s.pictures.front().given_range;
             return Values{range[0], range[1]};
         },
         [](Scene& s, Given v) {
             s.pictures.front().range = "given";
             s.pictures.front().given_range = {v[0], v[1]};
         }},
    }};
    return rows;
}

const ChangeableRow* find_changeable(std::string_view key) {
    for (const ChangeableRow& row : all_changeable())
        if (row.key == key) return &row;
    return nullptr;
}

void apply_change(Scene& scene, const Change& change) {
    const ChangeableRow* row = find_changeable(change.key);
    if (row == nullptr || !row->is_in(scene)) {
        std::string keys;
        for (const ChangeableRow& each : all_changeable())
            if (each.is_in(scene)) keys += fmt::format(" {}", each.key);
        throw Error(Loc{scene.file, 0, 0},
                    fmt::format("'{}' cannot be changed while this run goes on", change.key),
                    "what can be changed:" + keys);
    }
    check_values(*row, change);
    Scene changed = scene;
    row->set(changed, change.values);
    // A tolerance of 0 is one that scenes may have, but asks for another way of making steps.
    if (!row->is_in(changed))
        throw Error(fmt::format("{} must be > 0 while this run goes on, got {}", change.key,
                                scene::format_quantity(change.values[0], row->dimension)));
    if (const std::string problem = scene::problem_of_wetting(changed); !problem.empty())
        throw Error(fmt::format("{} = {}: {}", change.key,
                                scene::format_quantity(change.values[0], row->dimension), problem),
                    std::string(scene::k_allow_wetting));
    scene = std::move(changed);
}

std::vector<Change> changes_of_motion(std::span<const Change> changes) {
    std::vector<Change> result;
    for (const Change& change : changes)
        if (find_changeable(change.key)->of == ChangeableRow::Of::engine) result.push_back(change);
    return result;
}

std::string changes_text(std::span<const Change> changes) {
    std::string text;
    // fmt writes the shortest text that gives back exactly this number
    for (const Change& change : changes)
        text += fmt::format("{} {} {}\n", change.time_s, change.key, fmt::join(change.values, " "));
    return text;
}

std::vector<Change> parse_changes(const std::string& text, const std::string& name) {
    std::vector<Change> changes;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line);
        std::string time, word;
        Change change;
        words >> time >> change.key;
        const scene::Quantity t = scene::parse_quantity(time, scene::Dimension::number);
        const ChangeableRow* row = find_changeable(change.key);
        bool is_good = t.ok() && row != nullptr;
        change.time_s = t.value;
        while (words >> word) {
            const scene::Quantity value = scene::parse_quantity(word, scene::Dimension::number);
            is_good = is_good && value.ok();
            change.values.push_back(value.value);
        }
        if (!is_good || change.values.size() != n_values(*row))
            throw Error(Loc{name, number, 1},
                        fmt::format("wanted a change, 'time key value', got '{}'", line));
        changes.push_back(std::move(change));
    }
    return changes;
}

}  // namespace spheroscope
