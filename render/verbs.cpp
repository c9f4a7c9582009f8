#include "render/verbs.hpp"

#include "render/plot.hpp"

namespace spheroscope {

std::vector<cli::Verb> render_verbs() {
    return {movie_verb(), render_verb(), diff_verb(), export_verb(), figures_verb()};
}

reports::DrawPlot plot_drawer() {
    return [](const reports::Plot& plot, const std::string& path) -> std::vector<std::string> {
        render::draw_plot(plot, path + ".png", path + ".svg");
        return {path + ".png", path + ".svg"};
    };
}

}  // namespace spheroscope
