#include "engine/cli/doctor.hpp"
#include "engine/cli/program.hpp"
#include "engine/cli/reference.hpp"
#include "engine/cli/verb.hpp"
#include "engine/cli/verb_extract.hpp"
#include "engine/cli/verb_inspect.hpp"
#include "engine/cli/version.hpp"
#ifdef SPHEROSCOPE_HAS_RENDER
#include "render/inspect_drawers.hpp"
#include "render/probe.hpp"
#include "render/verbs.hpp"
#endif
#ifdef SPHEROSCOPE_HAS_VIEWER
#include "viewer/verbs.hpp"
#endif

#include <csignal>
#include <string>
#include <utility>
#include <vector>

int main(int argc, char** argv) {
    using namespace spheroscope;
    cli::open_standard_streams();
    // A full quota of file size is then an error of the write, with a message, and not the end.
    std::signal(SIGXFSZ, SIG_IGN);
    reports::DrawPlot draw;
    cli::PictureProbe probe;
    inspect::Drawers drawers;
#ifdef SPHEROSCOPE_HAS_RENDER
    draw = plot_drawer();
    probe = render::probe_pictures;
    drawers = inspect_drawers();
#endif
    std::vector<cli::Verb> verbs = cli::engine_verbs(draw);
    verbs.push_back(cli::inspect_verb(drawers));
    verbs.push_back(cli::extract_verb());
#ifdef SPHEROSCOPE_HAS_RENDER
    for (cli::Verb& verb : render_verbs()) verbs.push_back(std::move(verb));
#endif
#ifdef SPHEROSCOPE_HAS_VIEWER
    verbs.push_back(view_verb());
#endif
    verbs.push_back(cli::doctor_verb(probe));
    verbs.push_back(cli::man_verb(verbs));
    verbs.push_back(cli::completion_verb(verbs));
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return static_cast<int>(cli::run_program(arguments, verbs, cli::version_text()));
}
