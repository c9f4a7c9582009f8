#include "engine/base/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace spheroscope {

std::string Loc::text() const {
    if (file.empty() || line == 0) return file;
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

namespace {
std::string compose(const Loc& loc, const std::string& message, const std::string& hint) {
    std::string text = loc.text();
    if (!text.empty()) text += ": ";
    text += "error: " + message;
    if (!hint.empty()) text += "\n  hint: " + hint;
    return text;
}
}  // namespace

Error::Error(const Loc& loc, const std::string& message, const std::string& hint, ExitCode code)
    : std::runtime_error(compose(loc, message, hint)), loc_(loc), code_(code) {}

Error::Error(const std::string& message, const std::string& hint, ExitCode code)
    : Error(Loc{}, message, hint, code) {}

namespace detail {
void assertion_failed(const char* condition, const char* file, int line,
                      const std::string& detail) {
    std::fprintf(stderr, "%s:%d: internal error: '%s' does not hold: %s\n", file, line, condition,
                 detail.c_str());
    std::abort();
}
}  // namespace detail

}  // namespace spheroscope
