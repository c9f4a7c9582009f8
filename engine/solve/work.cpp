#include "engine/solve/work.hpp"

#include <array>
#include <cstddef>

namespace spheroscope {

void Work::add(const Work& other) {
    constexpr std::array counts{&Work::force_evaluations,
                                &Work::stiffness_evaluations,
                                &Work::contact_searches,
                                &Work::contact_candidates,
                                &Work::contact_pairs,
                                &Work::contact_too_deep,
                                &Work::linear_solves,
                                &Work::linear_iterations,
                                &Work::factorisations,
                                &Work::direct_solves,
                                &Work::steps,
                                &Work::rejected_steps};
    for (const auto count : counts) this->*count += other.*count;
    const auto add_rows = [](std::vector<TermCount>& rows, const std::vector<TermCount>& others) {
        for (const TermCount& row : others) {
            bool is_known = false;
            for (TermCount& own : rows)
                if (own.term == row.term) {
                    own.evaluations += row.evaluations;
                    is_known = true;
                }
            if (!is_known) rows.push_back(row);
        }
    };
    add_rows(terms, other.terms);
    add_rows(fields, other.fields);
}

}  // namespace spheroscope
