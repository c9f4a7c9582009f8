#pragma once

#include "render/image.hpp"
#include "render/osmesa_context.hpp"

namespace spheroscope::render {

/// Puts the network's picture into that of the cells: fully where it stands before them, with the
/// given opacity where cells hide it. Depths make that exact without sorting anything.
void add_network(Buffers& cells, const Buffers& network, double hidden_opacity);

/// Lays what is nearer than the cells over them, with the given opacity. Depths stay those of the
/// cells, so that their creases show through.
void add_glass(Buffers& cells, const Buffers& glass, double opacity);

/// Makes the final picture: `n_samples` x `n_samples` drawn pixels become one, which smooths all
/// edges, and lines along the creases between surfaces tell cells apart (narrow, so that they do
/// not shade the mapped colours). px_per_um: of the drawn pixels.
[[nodiscard]] Image make_image(const Buffers& drawn, int n_samples, double px_per_um);

}  // namespace spheroscope::render
