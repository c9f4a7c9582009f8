#include "engine/solve/method.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/choices.hpp"
#include "engine/stages/indentation.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace spheroscope {
namespace {

constexpr const char* k_scene = R"(
[cells]
arrangement = "centres"
nodes = 42
centres = [[0, 0, 0, 9], [17.5, 0, 0, 9], [8.7, 15, 0, 9], [8.7, 5, 14.5, 9]]
[cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
controller = "proportional"
[medium]
[contact]
[contact.adhesion]
omega = "0.5 nN/um"
[[stage]]
kind = "indent"
duration = "1 s"
direction = [0.2, 0, -2]
)";

/// Four cells that are about to be loaded.
struct Loading {
    explicit Loading(const std::vector<scene::Override>& overrides = {})
        : scene(scene::parse_scene(k_scene, "a.toml", overrides)),
          system(make_model(make_icosphere(42), cell_radii(scene, {})), build_parts(scene), 1) {
        state.x_um = start_positions(scene, system.model(), {});
        state.v_um_per_s.assign(state.x_um.size(), Vec3::Zero());
        state.volume_integral_s.assign(4, 0.0);
    }
    void begin(const scene::Stage& stage) {
        StageContext context{system, state, memory};
        Indentation(stage).begin(context);
    }
    std::string refusal(const scene::Stage& stage) {
        try {
            begin(stage);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    }
    scene::Scene scene;
    System system;
    State state;
    StageMemory memory;
};

TEST(Indentation, BeginsWithCellsInsideTheirHullAndAProbeThatTouchesTheFirstNode) {
    for (const double clearance_um : {0.0, 1.5}) {
        Loading loading;
        scene::Stage stage = loading.scene.stages[0];
        stage.clearance_um = clearance_um;
        loading.begin(stage);
        const Load& load = loading.state.load;
        ASSERT_NE(load.hull, nullptr);
        // the hull's planes are h0 away from the outermost nodes
        double nearest_um = 1e9;
        for (const Hull::Plane& plane : load.hull->planes)
            for (const Vec3& x : loading.state.x_um)
                nearest_um = std::min(nearest_um, plane.offset_um - plane.normal.dot(x));
        EXPECT_NEAR(nearest_um, 0.3, 1e-9);
        EXPECT_NEAR(load.probe.direction.norm(), 1.0, 1e-14);
        EXPECT_LT(load.probe.direction.z(), -0.99);
        EXPECT_NEAR(load.probe.friction_nN_s_per_um, 6.0 * std::numbers::pi * 0.05 * 27.0, 1e-12);
        double first_um = 1e9;  // distance of the nodes from the probe, moved by its clearance
        const Vec3 there = load.probe.start_um + clearance_um * load.probe.direction;
        for (const Vec3& x : loading.state.x_um)
            first_um = std::min(first_um, (x - there).norm() - 27.0);
        EXPECT_NEAR(first_um, 0.0, 1e-9);
    }
}

TEST(Indentation, OfCellsOutsideTheHullOrInsideTheProbeIsRefusedWithNodeAndDistance) {
    Loading loading;
    scene::Stage stage = loading.scene.stages[0];
    stage.hull_gap_um = -0.5;
    std::string text = loading.refusal(stage);
    EXPECT_NE(text.find("the hull does not contain the cells: node"), std::string::npos) << text;
    EXPECT_NE(text.find("is 0.5 um outside"), std::string::npos) << text;
    stage.hull_gap_um = 0.3;
    stage.clearance_um = -2.0;
    text = loading.refusal(stage);
    EXPECT_NE(text.find("the probe starts inside the cells: node"), std::string::npos) << text;
    stage.clearance_um = 0.0;
    stage.probe_radius_um = 1e-4;
    text = loading.refusal(stage);
    EXPECT_NE(text.find("meets no node"), std::string::npos) << text;
    EXPECT_FALSE(loading.state.load.probe.acts()) << "what is refused has not begun";
}

/// What a scene is refused with; "accepted" if it is not.
std::string refusal_of(const std::string& text, const std::vector<scene::Override>& overrides) {
    try {
        static_cast<void>(chosen_method(scene::parse_scene(text, "a.toml", overrides)));
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string with(std::string text, const std::string& part, const std::string& other) {
    return text.replace(text.find(part), part.size(), other);
}

TEST(Indentation, SceneThatCannotBeOneIsRefusedInItsLine) {
    struct Case {
        std::string key, value, words;
    };
    const std::vector<Case> cases{
        {"stage[0].clearance", "1 um", "accepted"},
        {"stage[0].hull_gap", "-1 um", "hull_gap = -1 um: the hull would not contain the cells"},
        {"stage[0].clearance", "-2 um", "the probe would start inside the cells"},
        {"stage[0].direction", "[0, 0, 0]", "wants a vector that is not zero"},
        {"method.name", "rkc", "the method rkc cannot move the probe"},
    };
    for (const Case& one : cases) {
        const std::string text =
            refusal_of(k_scene, std::vector<scene::Override>{{one.key, one.value}});
        EXPECT_NE(text.find(one.words), std::string::npos) << one.key << ": " << text;
    }
    std::string text =
        refusal_of(with(k_scene, "duration = \"1 s\"", "until = \"stationary\""), {});
    EXPECT_NE(text.find("not \"stationary\""), std::string::npos) << text;
    text =
        refusal_of(std::string(k_scene) + "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\n", {});
    EXPECT_NE(text.find("must be the last one"), std::string::npos) << text;
}

TEST(Indentation, PressesWithItsForceAndTheHullHoldsAgainstIt) {
    Loading loading(std::vector<scene::Override>{{"stage[0].direction", "[0, 0, -1]"},
                                                 {"stage[0].wall_stiffness", "1"}});
    loading.begin(loading.scene.stages[0]);
    const auto method = chosen_method(loading.scene).make(method_parameters(loading.scene));
    double last_way_um = 0.0;
    while (loading.state.time_s < 60.0) {
        ASSERT_TRUE(method->advance(loading.system, loading.state, 60.0, false).accepted);
        EXPECT_GE(loading.state.load.probe.way_um, last_way_um - 0.02);
        last_way_um = loading.state.load.probe.way_um;
    }
    ASSERT_FALSE(loading.system.evaluate(loading.state.x_um, loading.state.volume_integral_s, 0.0,
                                         loading.state.load));
    const Configuration at = loading.system.configuration();
    const Vec3 probe_nN = loading.system.parts().probe->sum_nN(at);
    const Vec3 hull_nN = loading.system.parts().hull->sum_nN(at);
    // What is left is friction: that of the probe, 25.4 nN s/um, and of four cells, 34 nN s/um.
    EXPECT_NEAR(probe_nN.z(), -15.0,
                26.0 * std::abs(loading.state.load.probe.speed_um_per_s) + 0.1);
    EXPECT_NEAR((probe_nN + hull_nN).norm(), 0.0, 0.5);
    EXPECT_GT(last_way_um, 0.3);
}

}  // namespace
}  // namespace spheroscope
