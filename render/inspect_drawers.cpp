#include "render/inspect_drawers.hpp"

#include "render/contact_sheet.hpp"
#include "render/node_sheet.hpp"

namespace spheroscope {

inspect::Drawers inspect_drawers() {
    return {[](const inspect::ContactStory& story, int frame, const std::string& png) {
                render::write_contact_sheet(story, frame, png);
            },
            [](const inspect::ContactStory& story, const std::string& mp4) {
                render::write_contact_movie(story, mp4);
            },
            [](const inspect::NodeMoment& moment, const std::string& made_by,
               const std::string& command, const std::string& png) {
                render::write_png(png, render::NodeSheet().draw(moment),
                                  render::node_sheet_texts(moment, made_by, command));
            }};
}

}  // namespace spheroscope
