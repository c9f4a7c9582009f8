#include "render/export_vtk.hpp"

#include "engine/base/error.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <vector>

namespace spheroscope::render {

namespace {

std::string name_with_unit(std::string_view name, std::string_view unit) {
    return unit.empty() || unit == "1" ? std::string(name) : fmt::format("{} ({})", name, unit);
}

/// Values, each repeated.
vtkNew<vtkFloatArray> array_of(const std::string& name, const std::vector<float>& values,
                               int n_components = 1, int n_repeats = 1) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(n_components);
    array->SetNumberOfValues(static_cast<vtkIdType>(values.size()) * n_repeats);
    float* out = array->GetPointer(0);
    for (const float value : values) out = std::fill_n(out, n_repeats, value);
    return array;
}

vtkNew<vtkIntArray> numbers(const std::string& name, int n_numbers, int n_repeats) {
    vtkNew<vtkIntArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfValues(static_cast<vtkIdType>(n_numbers) * n_repeats);
    int* out = array->GetPointer(0);
    for (int i = 0; i < n_numbers; ++i) out = std::fill_n(out, n_repeats, i);
    return array;
}

std::string text_of(vtkPolyData* data, double time_s) {
    // The name by which ParaView knows the time of a file.
    vtkNew<vtkDoubleArray> time;
    time->SetName("TimeValue");
    time->InsertNextValue(time_s);
    data->GetFieldData()->AddArray(time);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1) throw Error("VTK cannot write this frame");
    return writer->GetOutputString();
}

}  // namespace

std::string surfaces_vtp(const Snapshot& snapshot) {
    const RunHeader& header = *snapshot.header;
    const MeshTopology& topology = *header.topology;
    const int n_triangles = topology.n_triangles();
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    points->SetData(array_of("x (um)", snapshot.x_um, 3));
    data->SetPoints(points);

    vtkNew<vtkTypeInt32Array> corners, corner_begin;
    corners->SetNumberOfValues(3 * static_cast<vtkIdType>(header.n_cells) * n_triangles);
    corner_begin->SetNumberOfValues(static_cast<vtkIdType>(header.n_cells) * n_triangles + 1);
    int* corner = corners->GetPointer(0);
    for (int c = 0; c < header.n_cells; ++c)
        for (const MeshTopology::Triangle& triangle : topology.triangles)
            for (const int node : triangle) *corner++ = c * topology.n_nodes() + node;
    for (vtkIdType i = 0; i < corner_begin->GetNumberOfValues(); ++i)
        corner_begin->SetValue(i, static_cast<int>(3 * i));
    vtkNew<vtkCellArray> triangles;
    triangles->SetData(corner_begin, corners);
    data->SetPolys(triangles);

    data->GetPointData()->SetNormals(array_of("normal", snapshot.normal, 3));
    vtkCellData* on_triangles = data->GetCellData();
    on_triangles->AddArray(numbers("cell", header.n_cells, n_triangles));
    on_triangles->AddArray(array_of("pressure (kPa)", snapshot.pressure_kPa, 1, n_triangles));
    on_triangles->AddArray(array_of("volume (um^3)", snapshot.volume_um3, 1, n_triangles));
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        const Field& field = *header.fields[i];
        const std::string name = name_with_unit(field.name, field.unit);
        if (field.place == Place::node)
            data->GetPointData()->AddArray(array_of(name, snapshot.fields[i]));
        else
            on_triangles->AddArray(array_of(name, snapshot.fields[i], 1,
                                            field.place == Place::cell ? n_triangles : 1));
    }
    return text_of(data, snapshot.time_s);
}

std::string network_vtp(const Snapshot& snapshot) {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    points->SetData(array_of("x (um)", snapshot.centre_um, 3));
    data->SetPoints(points);
    vtkNew<vtkCellArray> lines;
    std::vector<float> force_nN, area_um2;
    for (const ContactLink& link : snapshot.links) {
        lines->InsertNextCell({link.cell_a, link.cell_b});
        force_nN.push_back(link.force_nN);
        area_um2.push_back(link.area_um2);
    }
    data->SetLines(lines);
    data->GetPointData()->AddArray(numbers("cell", snapshot.header->n_cells, 1));
    data->GetCellData()->AddArray(array_of("force (nN)", force_nN));
    data->GetCellData()->AddArray(array_of("area (um^2)", area_um2));
    return text_of(data, snapshot.time_s);
}

std::string pvd_text(std::span<const DatedFile> files) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                       "<Collection>\n";
    // The names are ours (frame numbers), so nothing has to be escaped.
    for (const DatedFile& file : files)
        text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", file.time_s,
                            file.name);
    return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace spheroscope::render
