#include "engine/store/xdmf.hpp"

#include "engine/base/xml_text.hpp"
#include "engine/store/atomic_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/run_format.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>

namespace spheroscope {
namespace {

/// `kind`: XDMF's number type and precision; `size`: "1280 3".
std::string data_item(std::string_view kind, const std::string& size, const std::string& file,
                      std::string_view object) {
    return fmt::format("<DataItem Format=\"HDF\" {} Dimensions=\"{}\">{}:{}</DataItem>", kind, size,
                       file, object);
}

constexpr std::string_view k_int32 = "NumberType=\"Int\" Precision=\"4\"";
constexpr std::string_view k_float32 = "NumberType=\"Float\" Precision=\"4\"";

}  // namespace

std::string xdmf_path(const std::string& run_path) {
    return std::filesystem::path(run_path).replace_extension(".xdmf").string();
}

std::string xdmf_text(const RunFileReader& run) {
    const RunHeader& header = *run.header();
    const std::uint64_t n_nodes = run_format::n_entries(header, Place::node);
    const std::uint64_t n_triangles = run_format::n_entries(header, Place::triangle);
    const std::string file = escape_xml(std::filesystem::path(run.path()).filename().string());
    const std::string vectors = fmt::format("{} 3", n_nodes);

    std::string text =
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n";
    auto out = std::back_inserter(text);
    fmt::format_to(out, "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                   escape_xml(header.title));
    for (int frame = 0; frame < run.n_frames(); ++frame) {
        const std::string step = run_format::step_path(frame);
        fmt::format_to(out, "<Grid Name=\"frame {}\" GridType=\"Uniform\">\n", frame);
        fmt::format_to(out, "  <Time Value=\"{}\"/>\n", run.time(frame));
        fmt::format_to(
            out, "  <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n",
            n_triangles,
            data_item(k_int32, fmt::format("{} 3", n_triangles), file, "/topology/triangles"));
        fmt::format_to(out, "  <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                       data_item(k_float32, vectors, file, step + "/x"));
        fmt::format_to(out,
                       "  <Attribute Name=\"normal\" AttributeType=\"Vector\" Center=\"Node\">{}"
                       "</Attribute>\n",
                       data_item(k_float32, vectors, file, step + "/normal"));
        for (const Field* field : header.fields) {
            if (field->place == Place::cell) continue;
            const std::string size = std::to_string(run_format::n_entries(header, field->place));
            // What XDMF calls a cell is a triangle of ours.
            fmt::format_to(out,
                           "  <Attribute Name=\"{} ({})\" AttributeType=\"Scalar\" Center=\"{}\">{}"
                           "</Attribute>\n",
                           escape_xml(field->name), escape_xml(field->unit),
                           field->place == Place::node ? "Node" : "Cell",
                           data_item(k_float32, size, file,
                                     escape_xml(run_format::field_path(frame, field->name))));
        }
        text += "</Grid>\n";
    }
    text += "</Grid>\n</Domain>\n</Xdmf>\n";
    return text;
}

void write_xdmf(const RunFileReader& run) {
    const std::string text = xdmf_text(run);
    AtomicFile file(xdmf_path(run.path()), AtomicFile::Mode::create);
    file.write(0, std::as_bytes(std::span(text)));
    file.commit();
}

}  // namespace spheroscope
