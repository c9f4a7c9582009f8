#include "engine/cli/verb_inspect.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/contact_output.hpp"
#include "engine/cli/frame_choice.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/step_output.hpp"
#include "engine/inspect/inspect_contact.hpp"
#include "engine/inspect/step_of_frame.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>

namespace spheroscope::cli {
namespace {

using inspect::ContactKey;
using inspect::FrameSystem;

struct InspectArguments {
    std::string file;
    std::string contact;  ///< "17-42"; empty: all contacts of the frame
    std::string node;     ///< "CELL:NODE"; empty: none
    FrameChoice frame;
    bool history = false, events = false, step = false, csv = false;
    CommonOptions common;
};

NodeOfCell parse_node(const std::string& text) {
    NodeOfCell key{-1, -1};
    const char *begin = text.data(), *end = begin + text.size();
    const auto first = std::from_chars(begin, end, key.cell);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
        const auto second = std::from_chars(first.ptr + 1, end, key.node);
        if (second.ec == std::errc() && second.ptr == end) return key;
    }
    throw Error("--node wants a cell and one of its nodes, for instance 17:203, got '" + text +
                "'");
}

void check(const InspectArguments& arguments) {
    if (arguments.csv && arguments.common.json)
        throw Error("--csv and --json exclude each other", "each of them is all of stdout");
    const auto wants_contact = [&](bool given, const char* option) {
        if (given && arguments.contact.empty())
            throw Error(fmt::format("{} is about one contact", option),
                        "name it with --contact 17-42; without it all contacts are listed");
    };
    wants_contact(arguments.history, "--history");
    wants_contact(arguments.events, "--events");
    const bool draws = !arguments.common.output.empty();
    if (draws && arguments.step) throw Error("--step has tables, and no picture");
    if (draws && arguments.contact.empty() && arguments.node.empty())
        throw Error("-o draws one contact, or the forces on one node",
                    "name it with --contact 17-42 or --node 17:203; without either all contacts "
                    "are listed");
    if (draws && !arguments.contact.empty() && !arguments.node.empty())
        throw Error("-o draws either the contact or the node", "leave out --contact or --node");
    const auto whole_run = [&](bool given, const char* option) {
        if (given && (arguments.frame.frame || !arguments.frame.time.empty()))
            throw Error(
                fmt::format("{} is about all frames; --frame and --time are about one", option));
    };
    if (arguments.step && !arguments.contact.empty())
        throw Error("--step is about all cells; --contact is about two of them");
    if (arguments.step && arguments.csv)
        throw Error("--step has several tables: --json has them all");
    whole_run(arguments.history, "--history");
    whole_run(arguments.events, "--events");
    if (!arguments.node.empty() && (arguments.history || arguments.events))
        throw Error("--node is about one frame; --history and --events are about all");
    if (arguments.history && arguments.events && arguments.csv)
        throw Error("--csv is one table: either --history or --events");
}

/// What is known of the run and the frame, at the top of every document.
nlohmann::json head_json(const RunFileReader& reader) {
    return {{"file", reader.path()},
            {"scene", reader.header()->scene_name},
            {"version", reader.header()->version},
            {"cells", reader.header()->n_cells},
            {"frames", reader.n_frames()},
            {"complete", reader.is_complete()}};
}

void add_frame(nlohmann::json& document, const Snapshot& frame) {
    document["frame"] = frame.frame;
    document["time_s"] = frame.time_s;
    document["stage"] = frame.stage_name;
}

std::string frame_text(const RunFileReader& reader, const Snapshot& frame) {
    return fmt::format("frame {} of {}, t = {:.6g} s, {}", frame.frame, reader.n_frames(),
                       frame.time_s, frame.stage_name);
}

/// The whole run of one contact.
void show_run(const InspectArguments& arguments, const RunFileReader& reader,
              const inspect::ContactStory& story) {
    if (arguments.common.json) {
        nlohmann::json document = head_json(reader);
        document["contact"] = story.key.text();
        if (arguments.history) {
            nlohmann::json rows = nlohmann::json::array();
            for (const auto& row : story.history) rows.push_back(summary_json(row));
            document["history"] = std::move(rows);
        }
        if (arguments.events) {
            nlohmann::json rows = nlohmann::json::array();
            for (const auto& event : story.events) rows.push_back(event_json(event));
            document["events"] = std::move(rows);
        }
        print_json(document);
        return;
    }
    if (arguments.csv) {
        fmt::print("{}",
                   (arguments.history ? history_table(story.history) : events_table(story.events))
                       .csv_text());
        return;
    }
    fmt::print("contact {} in {}, {}\n", story.key.text(), reader.path(),
               counted(reader.n_frames(), "frame"));
    if (arguments.history) fmt::print("{}", history_table(story.history).aligned_text());
    if (!arguments.events) return;
    if (story.events.empty())
        fmt::print("no events: the contact neither forms nor breaks, and its force keeps its "
                   "sign\n");
    else
        fmt::print("{}", events_table(story.events).aligned_text());
}

/// One contact in one frame.
void show_contact(const InspectArguments& arguments, const RunFileReader& reader,
                  const SnapshotPtr& frame, const ContactKey& key) {
    FrameSystem pair(reader.header(), {key.cell_a, key.cell_b}, FrameSystem::Detail::contacts);
    pair.load(frame);
    const inspect::ContactReport report = inspect::inspect_contact(pair, key);
    std::optional<inspect::NodeForces> forces;
    if (!arguments.node.empty()) {
        const NodeOfCell node = parse_node(arguments.node);
        FrameSystem whole(reader.header(), {}, FrameSystem::Detail::forces);
        whole.load(frame);
        forces = inspect::forces_on_node(whole, node.cell, node.node);
    }
    if (arguments.common.json) {
        nlohmann::json document = head_json(reader);
        add_frame(document, *frame);
        document["contact"] = report_json(report);
        if (forces) document["node"] = node_json(*forces);
        print_json(document);
    } else if (arguments.csv) {
        fmt::print("{}", (forces ? node_table(*forces) : map_table(report)).csv_text());
    } else {
        fmt::print("contact {}, {}\n{}{}", key.text(), frame_text(reader, *frame),
                   report_text(report), forces ? node_text(*forces) : "");
    }
}

/// The step that would begin with one frame.
void show_step(const InspectArguments& arguments, const RunFileReader& reader,
               const SnapshotPtr& frame) {
    FrameSystem whole(reader.header(), {}, FrameSystem::Detail::forces);
    whole.load(frame);
    std::optional<NodeOfCell> node;
    if (!arguments.node.empty()) node = parse_node(arguments.node);
    const StepAnatomy anatomy = inspect::step_of_frame(whole, node);
    if (arguments.common.json) {
        nlohmann::json document = head_json(reader);
        add_frame(document, *frame);
        document["method"] = whole.scene().method.name;
        document["step"] = step_json(anatomy);
        print_json(document);
        return;
    }
    fmt::print("{}: a step of {} from here{}\n{}", frame_text(reader, *frame),
               whole.scene().method.name,
               frame->diagnostics.wall_radius_um > 0.0 ? ", with the wall at rest" : "",
               step_text(anatomy));
}

/// Throws Error (environment) in a program that cannot draw.
void check_can_draw(const inspect::Drawers& drawers) {
    if (!drawers.contact_sheet)
        throw Error("this program was built without pictures (SPHEROSCOPE_RENDER)",
                    "numbers come without -o", ExitCode::environment);
}

/// One node without a contact: numbers, and a picture where one is wanted.
void show_node(const InspectArguments& arguments, const RunFileReader& reader,
               const SnapshotPtr& frame, const Invocation& invocation,
               const inspect::Drawers& drawers) {
    FrameSystem whole(reader.header(), {}, FrameSystem::Detail::forces);
    const inspect::NodeMoment moment = inspect::node_in(whole, frame, parse_node(arguments.node));
    if (arguments.common.json) {
        nlohmann::json document = head_json(reader);
        add_frame(document, *frame);
        document["node"] = node_json(moment.forces);
        print_json(document);
    } else if (arguments.csv) {
        fmt::print("{}", node_table(moment.forces).csv_text());
    } else {
        fmt::print("{}{}", frame_text(reader, *frame), node_text(moment.forces));
    }
    const std::string& path = arguments.common.output;
    if (path.empty()) return;
    check_can_draw(drawers);
    drawers.node_sheet(moment, invocation.version, invocation.command_line, path);
    log_info(fmt::format("written to {}", path));
}

/// All contacts of one frame.
void show_frame(const InspectArguments& arguments, const RunFileReader& reader,
                const SnapshotPtr& frame) {
    FrameSystem whole(reader.header(), {}, FrameSystem::Detail::contacts);
    whole.load(frame);
    nlohmann::json document = head_json(reader);
    add_frame(document, *frame);
    const std::vector<inspect::ContactSummary> contacts = inspect::contacts_of(whole);
    if (arguments.common.json) {
        nlohmann::json rows = nlohmann::json::array();
        for (const auto& row : contacts) rows.push_back(summary_json(row));
        document["contacts"] = std::move(rows);
        print_json(document);
    } else if (arguments.csv) {
        fmt::print("{}", contacts_table(contacts).csv_text());
    } else {
        fmt::print("{}: {}\n", frame_text(reader, *frame), counted(contacts.size(), "contact"));
        if (!contacts.empty()) fmt::print("{}", contacts_table(contacts).aligned_text());
    }
}

void draw(const InspectArguments& arguments, const inspect::ContactStory& story, int frame,
          const inspect::Drawers& drawers) {
    const std::string& path = arguments.common.output;
    const std::string ending = std::filesystem::path(path).extension();
    check_can_draw(drawers);
    if (ending == ".png")
        drawers.contact_sheet(story, frame, path);
    else
        drawers.contact_movie(story, path);
    log_info(fmt::format("written to {}", path));
}

ExitCode inspect_file(const InspectArguments& arguments, const Invocation& invocation,
                      const inspect::Drawers& drawers) {
    check(arguments);
    if (arguments.common.quiet) make_log_quiet();
    const std::string ending = std::filesystem::path(arguments.common.output).extension();
    if (!arguments.common.output.empty() && ending != ".png" && ending != ".mp4")
        throw Error("-o wants a picture sheet (.png) or a movie (.mp4), got '" +
                    arguments.common.output + "'");
    if (!arguments.node.empty() && ending == ".mp4")
        throw Error("the forces on a node are drawn as a picture sheet (.png), got '" +
                    arguments.common.output + "'");
    std::optional<ContactKey> key;
    if (!arguments.contact.empty()) key = inspect::parse_contact(arguments.contact);
    const RunFileReader reader(arguments.file);
    const int frame = arguments.frame.number(reader);
    if (key) inspect::check_cells(*reader.header(), *key);
    if (!reader.is_complete())
        log_info(fmt::format("{}: the run has not come to its end ({}); it has {} so far",
                             reader.path(),
                             reader.outcome().empty() ? "not ended" : reader.outcome(),
                             counted(reader.n_frames(), "frame")));
    const SnapshotPtr snapshot = reader.frame(frame);
    const bool is_whole_run = arguments.history || arguments.events;
    if (arguments.step) {
        show_step(arguments, reader, snapshot);
        return ExitCode::ok;
    }
    if (snapshot->stage_name == "anneal")
        log_warning(fmt::format(
            "frame {} is of the seeding, which packs beads: its forces are what cells would feel "
            "in their places, and have moved nothing",
            frame));
    if (!key) {
        if (arguments.node.empty())
            show_frame(arguments, reader, snapshot);
        else
            show_node(arguments, reader, snapshot, invocation, drawers);
        return ExitCode::ok;
    }
    if (!is_whole_run && arguments.common.output.empty()) {
        show_contact(arguments, reader, snapshot, *key);
        return ExitCode::ok;
    }
    inspect::ContactStory story = inspect::tell_contact(
        reader.header(), [&reader](int i) { return reader.frame(i); }, reader.n_frames(), *key);
    story.made_by = invocation.version;
    story.command_line = invocation.command_line;
    if (is_whole_run) show_run(arguments, reader, story);
    if (!arguments.common.output.empty()) {
        // A sheet of a frame without the contact has nothing to show: the numbers say so.
        if (!is_whole_run && ending == ".png") show_contact(arguments, reader, snapshot, *key);
        draw(arguments, story, frame, drawers);
    }
    return ExitCode::ok;
}

}  // namespace

Verb inspect_verb(const inspect::Drawers& drawers) {
    return {"inspect", "lists the contacts of a run, or takes one of them apart",
            [drawers](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<InspectArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                command.option("--contact", arguments->contact,
                               "one contact, by its two cells, for instance 17-42: forces, area, "
                               "overlaps, pressure map, balance",
                               {"A-B"});
                add_frame_options(command, arguments->frame);
                command.option("--node", arguments->node,
                               "every force on one node, term by term, with the residual; with -o "
                               "as arrows",
                               {"CELL:NODE"});
                command.flag("--step", arguments->step,
                             "the step that would begin with this frame: the forces before and "
                             "after each term, the residual of each solve");
                command.flag("--history", arguments->history,
                             "the contact's numbers in all frames");
                command.flag("--events", arguments->events,
                             "when the contact forms, breaks, or its force changes sign");
                command.flag("--csv", arguments->csv,
                             "the table as CSV: contacts, history, events, forces on the node, "
                             "or the pressure map of one contact");
                add_common_options(command, arguments->common,
                                   {CommonOption::output, CommonOption::json, CommonOption::quiet});
                return [arguments, drawers](const Invocation& invocation) {
                    return inspect_file(*arguments, invocation, drawers);
                };
            }};
}

}  // namespace spheroscope::cli
