#include "engine/reports/variants.hpp"

#include <fmt/format.h>

namespace spheroscope::reports {

std::vector<scene::Override> overrides_of(const scene::Variant& variant) {
    std::vector<scene::Override> result;
    for (const std::string& text : variant.set) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw Error(variant.loc,
                        fmt::format("variant.set wants \"key=value\", got \"{}\"", text));
        result.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    return result;
}

}  // namespace spheroscope::reports
