#include "render/verify.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "render/movie_painter.hpp"
#include "render/provenance.hpp"

#include <charconv>
#include <sstream>

namespace spheroscope::render {

namespace {

/// On another machine edges may move by a pixel, and generated code may round differently
/// (tests/render/baseline_test.cpp shows that a change of one cell's colour is still seen).
constexpr ImageTolerance k_other_machine{255, 0.002, 0.98};
constexpr int k_threshold = 24;

const std::string& text_of(const PngTexts& texts, const std::string& key) {
    const auto found = texts.find(key);
    if (found == texts.end())
        throw Error("the picture does not say how it was drawn: it has no text '" + key + "'",
                    "pictures of movie and render do, unless another program has saved them anew");
    return found->second;
}

int number_of(const std::string& text, const std::string& key) {
    int number = -1;
    const char* const end = text.data() + text.size();
    const auto [at, failed] = std::from_chars(text.data(), end, number);
    if (failed != std::errc{} || at != end || number < 0)
        throw Error("the picture's text '" + key + "' wants a number, got '" + text + "'");
    return number;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

int n_shown(const PngTexts& texts) {
    static_cast<void>(text_of(texts, k_view_key));
    int n = 1;
    for (std::string prefix = MoviePainter::k_beside; texts.contains(prefix + k_view_key); ++n)
        prefix += MoviePainter::k_beside;
    return n;
}

Verification verify_picture(const PngFile& file, std::span<FrameSource* const> runs,
                            const std::string& drawn_by) {
    SPHEROSCOPE_ASSERT(static_cast<int>(runs.size()) == n_shown(file.texts),
                       "one source for each part that is shown");
    const scene::Picture picture = parse_description(text_of(file.texts, k_view_key)).picture;
    std::vector<MoviePainter::Shown> shown;
    std::vector<Survey> surveys;
    std::string prefix;
    for (std::size_t k = 0; k < runs.size(); ++k, prefix += MoviePainter::k_beside) {
        const int frame = number_of(text_of(file.texts, prefix + "Frame"), prefix + "Frame");
        if (frame >= runs[k]->n_frames())
            throw Error("the picture shows frame " + std::to_string(frame) + ", the run has only " +
                        counted(runs[k]->n_frames(), "frame"));
        const RunHeader& header = *runs[k]->frame(frame)->header;
        for (const auto& [key, got] :
             {std::pair<std::string, std::string>{"Scene", header.resolved_scene},
              std::pair<std::string, std::string>{"Seed", std::to_string(header.seed)}})
            if (text_of(file.texts, prefix + key) != got)
                throw Error("the picture is not of this run: its " + key + " is another one",
                            "without a run's file, the picture's own scene is simulated anew");
        const auto told = file.texts.find(prefix + k_changes_key);
        if ((told == file.texts.end() ? "" : told->second) != changes_until(*runs[k]->frame(frame)))
            throw Error("the picture is not of this run: something else was changed on its way",
                        "without a run's file, the picture's own scene is simulated anew");
        shown.push_back({frame, parse_description(text_of(file.texts, prefix + k_view_key)).view});
        surveys.push_back(survey_frames(*runs[k], picture));
    }
    MoviePainter painter(runs, surveys, picture, drawn_by);
    if (const auto caption = file.texts.find(MoviePainter::k_caption); caption != file.texts.end())
        painter.set_caption(lines_of(caption->second));
    Verification result;
    result.frame = shown[0].frame;
    result.drawn = painter.paint(shown);
    result.is_same_machine = text_of(file.texts, k_drawn_with_key) == painter.drawn_with() &&
                             text_of(file.texts, "Software") == "spheroscope " + drawn_by;
    result.difference = compare_images(file.image, result.drawn, k_threshold);
    result.reasons = broken_bounds(result.difference,
                                   result.is_same_machine ? ImageTolerance{} : k_other_machine);
    const std::string blank = blank_reason(file.image), drawn_blank = blank_reason(result.drawn);
    if (!blank.empty()) result.reasons.push_back("the picture " + blank);
    if (!drawn_blank.empty()) result.reasons.push_back("drawn again, it " + drawn_blank);
    return result;
}

}  // namespace spheroscope::render
