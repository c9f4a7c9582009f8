#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace spheroscope {

/// What a run has done, counted where it happens. A part of every report; tests assert that what a
/// scene does not need is exactly 0.
struct Work {
    struct TermCount {
        std::string term;
        std::int64_t evaluations = 0;  ///< of the whole system's force
    };
    std::vector<TermCount> terms;
    std::vector<TermCount> fields;  ///< all rows of the table of fields, whole aggregates
    std::int64_t force_evaluations = 0;
    std::int64_t stiffness_evaluations = 0;
    std::int64_t contact_searches = 0;
    std::int64_t contact_candidates = 0;  ///< pairs of triangles that were clipped
    std::int64_t contact_pairs = 0;
    std::int64_t contact_too_deep = 0;
    std::int64_t linear_solves = 0;  ///< iterative
    std::int64_t linear_iterations = 0;
    std::int64_t factorisations = 0;
    std::int64_t direct_solves = 0;
    std::int64_t steps = 0;
    std::int64_t rejected_steps = 0;

    /// Adds what another system of the same scene has done.
    void add(const Work& other);

    /// Evaluations of a term or a field by its name; 0 if it is not part of the run.
    [[nodiscard]] std::int64_t evaluations(const std::string& name) const {
        for (const std::vector<TermCount>* counts : {&terms, &fields})
            for (const TermCount& count : *counts)
                if (count.term == name) return count.evaluations;
        return 0;
    }
};

}  // namespace spheroscope
