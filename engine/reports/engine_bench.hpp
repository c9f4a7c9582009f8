#pragma once

#include "engine/base/repetitions.hpp"
#include "engine/contact/contact_timing.hpp"
#include "engine/scene/scene.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// Size of one benchmark: cells on a close-packed lattice, each turned by its own random rotation,
/// pressed 0.7 um into each other. The paper's parameters of case A.
struct BenchSize {
    int cells = 1, nodes = 162, threads = 1;
};

struct BenchOptions {
    Repetitions repetitions;                                          ///< of every timing
    scene::Precision precision = scene::Precision::single_precision;  ///< of the contact kernel
};

struct BenchTime {
    double wall_ms = 0.0, cpu_ms = 0.0;  ///< the least of several repetitions, each by itself
};

/// A part of the force evaluation, in one thread.
struct BenchTerm {
    std::string name;
    BenchTime time;
};

/// One step of a method.
struct BenchStep {
    std::string method;
    std::string message;  ///< why it failed; "" if it did not
    BenchTime time;       ///< of one step: the least of several that follow each other
    double dt_s = 0.0;
    double error_um = 0.0;  ///< the method's own estimate for the step; 0: it has none
    int linear_iterations = 0;
    std::uint64_t state_hash = 0;  ///< after four steps
};

struct BenchRow {
    BenchSize size;
    ContactTiming contact;         ///< one thread; all zero for one cell
    std::vector<BenchTerm> terms;  ///< geometry, then the force terms
    BenchTime force;               ///< whole evaluation of forces
    BenchTime stiffness;           ///< forces and stiffness
    double force_error = 0.0;      ///< of the contact kernel against contact_of_triangles, over the
                                   ///< largest nodal force; NaN: no contact
    BenchTime solve;               ///< (Gamma + dt K) v = F
    double solve_dt_s = 0.0;
    int solve_iterations = 0;
    double solve_residual = 0.0;  ///< |b - A v| / |b|, computed anew
    std::vector<BenchStep> steps;
    double memory_MB = 0.0;  ///< of the system, its states and the method that needs most
};

/// Sizes of the full benchmark, or of a part that takes seconds.
enum class BenchExtent { full, quick };
[[nodiscard]] std::vector<BenchSize> bench_sizes(BenchExtent extent);

/// Empty if options.repetitions.stop became true meanwhile.
[[nodiscard]] std::optional<BenchRow> run_bench(const BenchSize& size, const BenchOptions& options);

}  // namespace spheroscope::reports
