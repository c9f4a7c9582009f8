#include "engine/cli/program.hpp"
#include "engine/cli/verb.hpp"
#include "engine/cli/version.hpp"
#ifdef SPHEROSCOPE_HAS_RENDER
#include "render/verbs.hpp"
#endif

#include <csignal>
#include <string>
#include <utility>
#include <vector>

int main(int argc, char** argv) {
    using namespace spheroscope;
    // A full quota of file size is then an error of the write, with a message, and not the end.
    std::signal(SIGXFSZ, SIG_IGN);
    reports::DrawPlot draw;
#ifdef SPHEROSCOPE_HAS_RENDER
    draw = plot_drawer();
#endif
    std::vector<cli::Verb> verbs = cli::engine_verbs(draw);
#ifdef SPHEROSCOPE_HAS_RENDER
    for (cli::Verb& verb : render_verbs()) verbs.push_back(std::move(verb));
#endif
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return static_cast<int>(cli::run_program(arguments, verbs, cli::version_text()));
}
