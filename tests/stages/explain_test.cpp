// What `check --explain` says is what System builds.
#include "engine/forces/terms.hpp"
#include "engine/stages/build.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace spheroscope {
namespace {

const std::string k_shell = R"([scene]
title = "A drop"
[cells]
arrangement = "pair"
nodes = 42
radius = "9 um"
[cortex.tension]
gamma = "0.5 nN/um"
[cytosol]
controller = "proportional"
K = "5 kPa"
[medium]
eta_f = "0.05 kPa s"
[[stage]]
kind = "relax"
duration = "0.01 s"
)";

/// Scenes from the least to the most that one can have; the later tables come behind the same
/// start.
const std::vector<std::string>& scenes() {
    static const std::string viscosity = "[cortex.viscosity]\neta = \"1 kPa s\"\n";
    static const std::string contact =
        "[contact]\nh0 = \"0.3 um\"\n[contact.adhesion]\nomega = \"0.5 nN/um\"\n";
    static const std::string friction =
        "[contact.friction]\nnormal = \"0.05 kPa s/um\"\ntangential = \"0.05 kPa s/um\"\n";
    static const std::string euler = "[method]\nname = \"forward_euler\"\ndt = \"0.1 ms\"\n";
    static const std::vector<std::string> all{
        k_shell + euler,
        k_shell + euler + viscosity,
        k_shell + euler + viscosity + contact,
        k_shell + euler + viscosity + contact + friction,
        k_shell + contact,
        k_shell + "[contact]\nlaw = \"variational\"\n[contact.adhesion]\nW = \"0.25 nN/um\"\n",
        k_shell + "[cortex.elastic]\nE = \"20 kPa\"\n[cortex.bending]\n" + viscosity,
        k_shell + contact + "[[stage]]\nkind = \"compact\"\nduration = \"0.01 s\"\n",
        k_shell + contact + "[[stage]]\nkind = \"indent\"\nduration = \"0.01 s\"\n",
        k_shell + "[load.body_force]\nforce = [\"0 nN\", \"0 nN\", \"0.1 nN\"]\nopposed = true\n"};
    return all;
}

const PlanRow& row_of(const std::vector<PlanRow>& plan, std::string_view part) {
    const auto row = std::find_if(plan.begin(), plan.end(),
                                  [&](const PlanRow& each) { return each.part == part; });
    if (row == plan.end()) throw std::runtime_error("no row " + std::string(part));
    return *row;
}

TEST(Explain, NamesExactlyTheTermsThatAreBuilt) {
    for (const std::string& text : scenes()) {
        SCOPED_TRACE(text);
        const scene::Scene scene = scene::parse_scene(text, "a.toml");
        std::set<std::string> built, said;
        for (const auto& term : build_parts(scene).terms) built.insert(std::string(term->name()));
        const std::vector<PlanRow> plan = explain(scene);
        for (const ForceTermRow& term : force_terms())
            if (row_of(plan, term.name).is_in) said.insert(std::string(term.name));
        const bool by_traction = row_of(plan, "contact, law traction").is_in;
        const bool by_energy = row_of(plan, "contact, law variational").is_in;
        EXPECT_FALSE(by_traction && by_energy);
        if (by_traction || by_energy) said.insert("contact");
        EXPECT_EQ(said, built);
    }
}

TEST(Explain, NamesTheFrictionsTheSearchAndTheSolverThatAStepUses) {
    for (const std::string& text : scenes()) {
        SCOPED_TRACE(text);
        const scene::Scene scene = scene::parse_scene(text, "a.toml");
        const Model model = make_model(make_icosphere(42), cell_radii(scene, {}), 0.0);
        State state;
        state.x_um = start_positions(scene, model, {});
        state.v_um_per_s.assign(model.n_all_nodes(), Vec3::Zero());
        state.volume_integral_s.assign(2, 0.0);
        System system(model, build_parts(scene), 1);
        const auto method = find_method(scene.method.name)->make(method_parameters(scene));
        for (int step = 0; step < 2; ++step)
            ASSERT_TRUE(method->advance(system, state, 1.0, false).accepted);
        const Work work = system.work();
        const Frictions& frictions = system.parts().frictions;
        const std::vector<PlanRow> plan = explain(scene);
        EXPECT_EQ(row_of(plan, "contact search").is_in, work.contact_searches > 0);
        EXPECT_EQ(row_of(plan, "solver, one factorisation").is_in, work.direct_solves > 0);
        EXPECT_EQ(row_of(plan, "solver, conjugate gradients").is_in, work.linear_solves > 0);
        EXPECT_EQ(row_of(plan, "cortex.viscosity").is_in, frictions.edge_nN_s_per_um > 0.0);
        EXPECT_EQ(row_of(plan, "contact.friction").is_in, frictions.contact.has_value());
        EXPECT_EQ(row_of(plan, "medium").is_in, frictions.eta_f_kPa_s > 0.0);
        EXPECT_EQ(row_of(plan, "cytosol, derivative part").is_in,
                  !system.volume_friction().empty());
        EXPECT_TRUE(row_of(plan, "method " + scene.method.name).is_in);
    }
}

TEST(Explain, FindsTheDerivativePartOfThePidController) {
    std::string text = k_shell + "[cortex.viscosity]\neta = \"1 kPa s\"\n";
    text.replace(text.find("proportional"), 12, "pid");
    const scene::Scene scene = scene::parse_scene(text, "a.toml");
    const Model model = make_model(make_icosphere(42), cell_radii(scene, {}), 0.0);
    const System system(model, build_parts(scene), 1);
    EXPECT_FALSE(system.volume_friction().empty());
    EXPECT_TRUE(row_of(explain(scene), "cytosol, derivative part").is_in);
}

TEST(Explain, GivesTheLineOfTheTableOrTheTableThatIsMissing) {
    const std::vector<PlanRow> plan = explain(scene::parse_scene(scenes()[1], "a.toml"));
    EXPECT_EQ(row_of(plan, "cortex.tension").because, "a.toml:7:1");
    EXPECT_EQ(row_of(plan, "stage 0, relax").because, "a.toml:14:1");
    EXPECT_EQ(row_of(plan, "method forward_euler").because, "a.toml:17:1");
    EXPECT_EQ(row_of(plan, "cortex.bending").because, "no [cortex.bending]");
    EXPECT_EQ(row_of(plan, "field sigma_nn").because, "no [contact]");
    EXPECT_EQ(row_of(plan, "friction matrix").because,
              "the same in all steps: [cortex.viscosity] (a.toml:20:1) without [contact.friction]");
}

TEST(Explain, SaysWhereTheIntegralOfTheVolumeControllerIsFrozen) {
    const std::string wall = k_shell + "[contact]\nh0 = \"0.3 um\"\n[contact.adhesion]\nomega = "
                                       "\"0.5 nN/um\"\n[[stage]]\nkind = \"compact\"\nduration = "
                                       "\"0.01 s\"\n";
    std::string pid = wall;
    pid.replace(pid.find("\"proportional\""), 14, "\"pid\"\nT_I = \"0.1 s\"");
    const std::string frozen = "the integral of the volume controller is frozen";
    const auto because = [](const std::string& text, const char* stage) {
        return row_of(explain(scene::parse_scene(text, "a.toml")), stage).because;
    };
    EXPECT_NE(because(pid, "stage 1, compact").find(frozen), std::string::npos);
    EXPECT_EQ(because(pid, "stage 0, relax").find(frozen), std::string::npos);
    EXPECT_EQ(because(wall, "stage 1, compact").find(frozen), std::string::npos);
}

TEST(Methods, ThatCannotHoldAnExactVolumeSaySoInTheLineOfTheScene) {
    std::string exact = k_shell;
    exact.replace(exact.find("\"proportional\"\nK = \"5 kPa\""), 26, "\"exact\"");
    const auto plan_with = [&](const std::string& method) {
        return explain(
            scene::parse_scene(exact + "[method]\nname = \"" + method + "\"\n", "a.toml"));
    };
    for (const MethodRow& row : all_methods()) {
        const std::string name(row.name);
        if (row.holds_exact_volume) {
            EXPECT_NO_THROW(plan_with(name)) << name;
            continue;
        }
        try {
            static_cast<void>(plan_with(name));
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find("a.toml:9:1"), std::string::npos) << text;
            EXPECT_NE(text.find(name + " cannot hold"), std::string::npos) << text;
            EXPECT_NE(text.find("linearly_implicit equilibrium"), std::string::npos) << text;
        }
    }
}

}  // namespace
}  // namespace spheroscope
