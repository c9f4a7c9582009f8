// When a relaxation is at rest: each clause of the condition, one after the other.
#include "engine/stages/build.hpp"
#include "engine/stages/relaxation.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace spheroscope {
namespace {

constexpr const char* k_scene = R"(
[cells]
arrangement = "single"
radius = "9 um"
nodes = 42
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
[medium]
[[stage]]
kind = "relax"
duration = "1 s"
)";

/// A relaxation that is measured once a second; what is measured is made up.
struct Relaxing {
    Relaxing()
        : scene(scene::parse_scene(k_scene, "a.toml")),
          system(make_model(make_icosphere(42), cell_radii(scene, {})), build_parts(scene), 1) {
        stage.kind = scene::StageKind::relax;
        stage.cap_s = 100.0;
        totals.sigma_h_core_kPa = -0.01;
        totals.sigma_h_size_kPa = 0.02;
        totals.sigma_h_mean_kPa = 0.001;
        totals.mean_pressure_kPa = 0.1;
        totals.coordination_Z = 10.0;
        totals.contact_fraction = 0.5;
        totals.virial_defect = 0.005;
        totals.normal_speed_rms_um_per_s = 0.5e-3;
    }
    StageEnd measure() {
        StageContext context{system, state, memory};
        const StageEnd end = Relaxation(stage).after_measure(context, totals);
        state.time_s += 1.0;
        return end;
    }
    /// What the last of n measurements finds.
    StageEnd after(int n) {
        StageEnd end = StageEnd::none;
        for (int k = 0; k < n; ++k) end = measure();
        return end;
    }
    scene::Scene scene;
    System system;
    scene::Stage stage;
    State state;
    StageMemory memory;
    Totals totals{};
};

TEST(RestOfARelaxation, WantsFiveSecondsInWhichNothingChanges) {
    Relaxing steady;
    steady.stage.until = scene::Until::rest;
    EXPECT_EQ(steady.after(5), StageEnd::none);  // 4 s have passed
    EXPECT_EQ(steady.measure(), StageEnd::rest);
}

TEST(RestOfARelaxation, IsNotThereIfOneClauseIsNotMet) {
    struct Clause {
        const char* name;
        std::function<void(Totals&)> break_it;
        StageEnd stationary;
    };
    // Changes are made after the first of six measurements.
    for (const Clause& clause :
         {Clause{"speed", [](Totals& t) { t.normal_speed_rms_um_per_s = 1.1e-3; },
                 StageEnd::stationary},
          Clause{"virial", [](Totals& t) { t.virial_defect = 0.011; }, StageEnd::none},
          Clause{"core", [](Totals& t) { t.sigma_h_core_kPa -= 0.0051 * 0.02; }, StageEnd::none},
          Clause{"Z", [](Totals& t) { t.coordination_Z *= 1.0051; }, StageEnd::none},
          Clause{"contact", [](Totals& t) { t.contact_fraction *= 1.0051; }, StageEnd::none}})
        for (const scene::Until until : {scene::Until::rest, scene::Until::stationary}) {
            Relaxing moving;
            moving.stage.until = until;
            moving.measure();
            clause.break_it(moving.totals);
            const StageEnd wanted =
                until == scene::Until::rest ? StageEnd::none : clause.stationary;
            EXPECT_EQ(moving.after(5), wanted) << clause.name;
        }
}

TEST(RestOfARelaxation, IsThereAfterChangesThatAreSmallEnough) {
    Relaxing slow;
    slow.stage.until = scene::Until::rest;
    slow.measure();
    slow.totals.sigma_h_core_kPa -= 0.0049 * 0.02;  // of the mean |sigma_h|, which is larger
    slow.totals.coordination_Z *= 1.0049;
    slow.totals.contact_fraction *= 0.9951;
    EXPECT_EQ(slow.after(5), StageEnd::rest);
}

TEST(RestOfARelaxation, LeavesOutAVirialOfNoStressAndWhatASceneHasNot) {
    Relaxing unstressed;
    unstressed.stage.until = scene::Until::rest;
    unstressed.totals.virial_defect = 1.0;
    unstressed.totals.sigma_h_mean_kPa = 0.5e-4 * unstressed.totals.mean_pressure_kPa;
    EXPECT_EQ(unstressed.after(6), StageEnd::rest);
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    Relaxing single;
    single.stage.until = scene::Until::rest;
    single.totals.virial_defect = single.totals.sigma_h_core_kPa = undefined;
    single.totals.coordination_Z = single.totals.contact_fraction = undefined;
    EXPECT_EQ(single.after(6), StageEnd::rest);
}

TEST(TimedRelaxation, IsJudgedOnceAtItsEndByWhatHoldsThere) {
    struct Case {
        double duration_s, speed_um_per_s;
        StageEnd wanted;
    };
    for (const Case& c : {Case{8.0, 0.5e-3, StageEnd::rest}, Case{8.0, 2e-3, StageEnd::stationary},
                          Case{4.0, 0.5e-3, StageEnd::none}}) {
        Relaxing timed;
        timed.stage.until = scene::Until::duration;
        timed.stage.duration_s = c.duration_s;
        timed.totals.normal_speed_rms_um_per_s = c.speed_um_per_s;
        for (int k = 0; k < static_cast<int>(c.duration_s); ++k)
            EXPECT_EQ(timed.measure(), StageEnd::none) << "before its end";
        EXPECT_EQ(timed.measure(), c.wanted) << c.duration_s << ' ' << c.speed_um_per_s;
    }
}

TEST(TimedRelaxation, OfWhatHasNoMeasuresIsNotStationaryWhileItMoves) {
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    Relaxing drop;
    drop.stage.until = scene::Until::duration;
    drop.stage.duration_s = 8.0;
    drop.totals.virial_defect = drop.totals.sigma_h_core_kPa = undefined;
    drop.totals.coordination_Z = drop.totals.contact_fraction = undefined;
    drop.totals.normal_speed_rms_um_per_s = 2e-3;
    EXPECT_EQ(drop.after(9), StageEnd::none);
}

TEST(TimedRelaxation, GoesOnWithTheFiveSecondsOfTheOneBefore) {
    Relaxing first;
    first.stage.until = scene::Until::rest;
    ASSERT_EQ(first.after(6), StageEnd::rest);
    first.stage.until = scene::Until::duration;
    first.stage.duration_s = 1.0;
    first.memory.start_s = first.state.time_s - 1.0;  // of the last measurement
    EXPECT_EQ(first.measure(), StageEnd::rest);
    first.totals.contact_fraction *= 1.0051;
    first.memory.start_s += 1.0;
    EXPECT_EQ(first.measure(), StageEnd::none);
}

}  // namespace
}  // namespace spheroscope
