#include "render/probe.hpp"

#include "render/osmesa_context.hpp"
#include "render/text.hpp"

namespace spheroscope::render {

std::string probe_pictures() {
    const TextPainter fonts;
    return OsmesaContext(64, 48).description();
}

}  // namespace spheroscope::render
