#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/report_output.hpp"
#include "render/image_diff.hpp"
#include "render/png.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spheroscope {
namespace {

struct DiffArguments {
    std::string reference, other;
    std::optional<double> share, similarity;
    int threshold = 8;
    cli::CommonOptions common;
};

/// Every bit counts unless a tolerance is given; then only what it says.
render::ImageTolerance tolerance_of(const DiffArguments& arguments) {
    if (!arguments.share && !arguments.similarity) return {};
    return {255, arguments.share.value_or(1.0), arguments.similarity.value_or(-1.0)};
}

ExitCode diff(const DiffArguments& arguments) {
    for (const std::string& input : {arguments.reference, arguments.other})
        cli::refuse_own_input(arguments.common.output, input);
    const render::Image reference = render::read_png(arguments.reference).image;
    const render::Image other = render::read_png(arguments.other).image;
    if (arguments.common.json &&
        (reference.width != other.width || reference.height != other.height))
        cli::print_json({{"equal", false}, {"reasons", {"the sizes differ"}}});
    const render::ImageDifference d = render::compare_images(reference, other, arguments.threshold);
    std::vector<std::string> reasons = render::broken_bounds(d, tolerance_of(arguments));
    for (const auto& [image, path] :
         {std::pair{&reference, &arguments.reference}, std::pair{&other, &arguments.other}}) {
        const std::string blank = render::blank_reason(*image);
        if (!blank.empty()) reasons.push_back(*path + " " + blank + ", so it shows nothing");
    }
    const bool equal = reasons.empty();
    if (!arguments.common.output.empty())
        render::write_png(arguments.common.output, render::difference_sheet(reference, other));
    if (arguments.common.json) {
        cli::print_json({{"equal", equal},
                         {"reasons", reasons},
                         {"threshold", arguments.threshold},
                         {"max_difference", d.max_difference},
                         {"mean_difference", d.mean_difference},
                         {"share_over_threshold", d.share_over_threshold},
                         {"share_over_threshold_shifted", d.share_over_threshold_shifted},
                         {"similarity", d.similarity},
                         {"worst_similarity", d.worst_similarity}});
    } else {
        fmt::print("{}: largest difference {} of 255, mean {:.4g}, {:.4g} of the pixels over {} "
                   "({:.4g} when edges may move by a pixel), similarity {:.5f} (worst block "
                   "{:.3f})\n",
                   equal ? "equal" : "different", d.max_difference, d.mean_difference,
                   d.share_over_threshold, arguments.threshold, d.share_over_threshold_shifted,
                   d.similarity, d.worst_similarity);
        for (const std::string& reason : reasons) fmt::print("  {}\n", reason);
    }
    return equal ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

cli::Verb diff_verb() {
    return {"diff", "compares two pictures; exit code 4 if they differ",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<DiffArguments>();
                command.argument("A.png", arguments->reference, "reference");
                command.argument("B.png", arguments->other, "picture to compare");
                command.option("--tolerance", arguments->share,
                               "share of pixels that may differ by more than the threshold, also "
                               "when edges may move by a pixel (default: every bit counts)",
                               cli::between(0.0, 1.0));
                command.option("--similarity", arguments->similarity,
                               "structural similarity that is enough, at most 1 (default: every "
                               "bit counts)",
                               cli::between(-1.0, 1.0));
                command.option("--threshold", arguments->threshold,
                               "difference of a channel (0 to 255) that counts",
                               cli::between(0, 255));
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output, CommonOption::json});
                return [arguments](const cli::Invocation&) { return diff(*arguments); };
            }};
}

}  // namespace spheroscope
