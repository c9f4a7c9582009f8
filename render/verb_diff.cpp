#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "render/image_diff.hpp"
#include "render/png.hpp"
#include "render/verbs.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace spheroscope {
namespace {

struct DiffArguments {
    std::string reference, other;
    double tolerance = 0.0;
    int threshold = 8;
    cli::CommonOptions common;
};

ExitCode diff(const DiffArguments& arguments) {
    const render::Image reference = render::read_png(arguments.reference).image;
    const render::Image other = render::read_png(arguments.other).image;
    const render::ImageDifference d = render::compare_images(reference, other, arguments.threshold);
    const bool equal = arguments.tolerance > 0.0
                           ? d.share_over_threshold_shifted <= arguments.tolerance
                           : d.max_difference == 0;
    if (!arguments.common.output.empty())
        render::write_png(arguments.common.output, render::difference_sheet(reference, other));
    if (arguments.common.json)
        cli::print_json({{"equal", equal},
                         {"max_difference", d.max_difference},
                         {"mean_difference", d.mean_difference},
                         {"share_over_threshold", d.share_over_threshold},
                         {"share_over_threshold_shifted", d.share_over_threshold_shifted},
                         {"similarity", d.similarity}});
    else
        fmt::print("{}: largest difference {} of 255, mean {:.4g}, {:.4g} of the pixels over {} "
                   "({:.4g} when edges may move by a pixel), similarity {:.5f}\n",
                   equal ? "equal" : "different", d.max_difference, d.mean_difference,
                   d.share_over_threshold, arguments.threshold, d.share_over_threshold_shifted,
                   d.similarity);
    return equal ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

cli::Verb diff_verb() {
    return {"diff", "compares two pictures; exit code 4 if they differ",
            [](CLI::App& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<DiffArguments>();
                command.add_option("A.png", arguments->reference, "reference")->required();
                command.add_option("B.png", arguments->other, "picture to compare")->required();
                command.add_option("--tolerance", arguments->tolerance,
                                   "share of pixels that may differ by more than the threshold "
                                   "after edges moved by a pixel; 0: every bit counts");
                command
                    .add_option("--threshold", arguments->threshold,
                                "difference of a channel (0 to 255) that counts")
                    ->check(CLI::Range(0, 255));
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output, CommonOption::json});
                return [arguments](const cli::Invocation&) { return diff(*arguments); };
            }};
}

}  // namespace spheroscope
