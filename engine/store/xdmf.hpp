#pragma once

#include <string>

namespace spheroscope {

class RunFileReader;

/// "out/a.h5" -> "out/a.xdmf"
[[nodiscard]] std::string xdmf_path(const std::string& run_path);

/// An XDMF 3 description of the run for ParaView: a temporal collection of the triangle mesh with
/// the fields of nodes and triangles. Every array is one whole dataset of the run file. Fields of
/// whole cells are left out: XDMF knows values per node and per triangle only.
[[nodiscard]] std::string xdmf_text(const RunFileReader& run);

/// Writes xdmf_text() beside the run file, complete or not at all. Throws Error.
void write_xdmf(const RunFileReader& run);

}  // namespace spheroscope
