#include "render/verbs.hpp"

namespace spheroscope {

std::vector<cli::Verb> render_verbs() { return {movie_verb(), render_verb(), diff_verb()}; }

}  // namespace spheroscope
