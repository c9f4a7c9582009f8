#include "engine/scene/shots.hpp"

#include "engine/scene/units.hpp"

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace spheroscope::scene {
namespace {

/// What follows `word` and a space in `text`.
std::optional<std::string_view> after(std::string_view text, std::string_view word) {
    if (!text.starts_with(word)) return std::nullopt;
    return text.substr(word.size());
}

class Parser {
  public:
    Parser(const Picture& picture, const std::string& text) : picture_(picture), text_(text) {}

    [[nodiscard]] Shot shot() const {
        if (const auto rest = after(text_, "play to ")) {
            if (*rest == "end")
                return {Shot::Kind::play, std::numeric_limits<double>::infinity(), 0, 0, false};
            const double until_s = quantity(*rest, Dimension::time);
            if (until_s < 0.0) fail("a time before the run begins");
            return {Shot::Kind::play, until_s, 0, 0, false};
        }
        if (const auto rest = after(text_, "freeze ")) {
            const std::size_t comma = rest->find(", orbit ");
            const double movie_s = quantity(rest->substr(0, comma), Dimension::time);
            if (!(movie_s > 0.0 && movie_s <= 600.0)) fail("wanted is a time of at most 10 min");
            const double orbit_deg =
                comma == std::string_view::npos
                    ? 0.0
                    : quantity(rest->substr(comma + std::string_view(", orbit ").size()),
                               Dimension::view_angle);
            return {Shot::Kind::freeze, 0, movie_s, orbit_deg, false};
        }
        if (text_ == "cutaway on") return {Shot::Kind::cutaway, 0, 0, 0, true};
        if (text_ == "cutaway off") return {Shot::Kind::cutaway, 0, 0, 0, false};
        fail("no such shot");
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(picture_.loc, "picture.shots: \"" + text_ + "\": " + why,
                    "shots are \"play to 12 s\", \"play to end\", \"freeze 2 s\", \"freeze 4 s, "
                    "orbit 360 deg\", \"cutaway on\", \"cutaway off\"");
    }

  private:
    [[nodiscard]] double quantity(std::string_view words, Dimension wanted) const {
        const Quantity result = parse_quantity(words, wanted);
        if (!result.ok())
            fail("wanted is " + std::string(wanted == Dimension::time ? "a time" : "an angle") +
                 ", got \"" + std::string(words) + "\" " + result.problem);
        return result.value;
    }

    const Picture& picture_;
    const std::string& text_;
};

}  // namespace

std::vector<Shot> parse_shots(const Picture& picture) {
    std::vector<Shot> shots;
    double played_s = -1.0;
    for (const std::string& text : picture.shots) {
        const Parser parser(picture, text);
        shots.push_back(parser.shot());
        if (shots.back().kind != Shot::Kind::play) continue;
        if (shots.back().until_s <= played_s)
            parser.fail("the shots before have played this time already");
        played_s = shots.back().until_s;
    }
    if (!shots.empty() && played_s < 0.0)
        throw Error(picture.loc, "picture.shots plays nothing",
                    "end the list with \"play to end\"");
    return shots;
}

}  // namespace spheroscope::scene
