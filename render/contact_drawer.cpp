#include "render/contact_drawer.hpp"

#include "render/contact_sheet.hpp"

namespace spheroscope {

inspect::DrawContact contact_drawer() {
    return {[](const inspect::ContactStory& story, int frame, const std::string& png) {
                render::write_contact_sheet(story, frame, png);
            },
            [](const inspect::ContactStory& story, const std::string& mp4) {
                render::write_contact_movie(story, mp4);
            }};
}

}  // namespace spheroscope
