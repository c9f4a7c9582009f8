// What is exported is read back by VTK's own reader.
#include "render/export_vtk.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::render {
namespace {

vtkNew<vtkPolyData> read(const std::string& text) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(text);
    reader->Update();
    vtkNew<vtkPolyData> data;
    data->ShallowCopy(reader->GetOutput());
    return data;
}

/// All values are there, in order, with each repeated; NaN where it was NaN.
void expect_values(vtkDataArray* array, const std::vector<float>& values, int n_repeats) {
    ASSERT_NE(array, nullptr);
    ASSERT_EQ(array->GetNumberOfValues(), static_cast<vtkIdType>(values.size()) * n_repeats);
    int n_wrong = 0;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
        for (int k = 0; k < array->GetNumberOfComponents(); ++k) {
            const auto got = static_cast<float>(array->GetComponent(i, k));
            const float wanted = values[static_cast<std::size_t>(
                (i / n_repeats) * array->GetNumberOfComponents() + k)];
            if (!(got == wanted || (std::isnan(got) && std::isnan(wanted)))) ++n_wrong;
        }
    EXPECT_EQ(n_wrong, 0) << array->GetName();
}

TEST(Export, VtkReadsEveryNodeTriangleAndFieldBack) {
    const auto snapshot = synthetic::make_aggregate(4, 42);
    const vtkNew<vtkPolyData> data = read(surfaces_vtp(*snapshot));
    const MeshTopology& topology = *snapshot->header->topology;
    const int n_triangles = topology.n_triangles();
    ASSERT_EQ(data->GetNumberOfPoints(), 4 * 42);
    ASSERT_EQ(data->GetNumberOfPolys(), 4 * n_triangles);
    expect_values(data->GetPoints()->GetData(), snapshot->x_um, 1);
    vtkNew<vtkIdList> corners;
    data->GetCellPoints(3 * n_triangles + 5, corners);
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(corners->GetId(k), 3 * 42 + topology.triangles[5][static_cast<std::size_t>(k)]);

    expect_values(data->GetPointData()->GetNormals(), snapshot->normal, 1);
    expect_values(data->GetPointData()->GetArray("tension (nN/um)"), snapshot->fields[0], 1);
    vtkCellData* on_triangles = data->GetCellData();
    expect_values(on_triangles->GetArray("normal_stress (kPa)"), snapshot->fields[1], 1);
    expect_values(on_triangles->GetArray("mean_stress (kPa)"), snapshot->fields[2], n_triangles);
    expect_values(on_triangles->GetArray("pressure (kPa)"), snapshot->pressure_kPa, n_triangles);
    expect_values(on_triangles->GetArray("cell"), {0, 1, 2, 3}, n_triangles);
    EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 12.4);
}

TEST(Export, EveryCellIsAClosedSurfaceWhoseTrianglesAndNormalsFaceOutward) {
    const auto snapshot = synthetic::make_aggregate(13, 162);
    const vtkNew<vtkPolyData> data = read(surfaces_vtp(*snapshot));
    // By VTK's own rules: no edge has one triangle or three, and each cell's volume is above zero.
    vtkNew<vtkFeatureEdges> open_edges;
    open_edges->SetInputData(data);
    open_edges->FeatureEdgesOff();
    open_edges->Update();
    EXPECT_EQ(open_edges->GetOutput()->GetNumberOfCells(), 0);
    vtkNew<vtkPolyDataNormals> oriented;  // turns triangles over until all face outward
    oriented->SetInputData(data);
    oriented->SplittingOff();
    oriented->ConsistencyOn();
    oriented->AutoOrientNormalsOn();
    oriented->Update();
    vtkDataArray* const stored = data->GetPointData()->GetNormals();
    vtkDataArray* const outward = oriented->GetOutput()->GetPointData()->GetNormals();
    ASSERT_EQ(outward->GetNumberOfTuples(), stored->GetNumberOfTuples());
    double least = 1.0;
    for (vtkIdType i = 0; i < stored->GetNumberOfTuples(); ++i) {
        double product = 0.0;
        for (int k = 0; k < 3; ++k)
            product += stored->GetComponent(i, k) * outward->GetComponent(i, k);
        least = std::min(least, product);
    }
    EXPECT_GT(least, 0.8) << "node normals, averaged in two ways";
    vtkNew<vtkIdList> as_stored, as_oriented;
    int n_turned = 0;
    for (vtkIdType t = 0; t < data->GetNumberOfPolys(); ++t) {
        data->GetCellPoints(t, as_stored);
        oriented->GetOutput()->GetCellPoints(t, as_oriented);
        for (vtkIdType k = 0; k < 3; ++k)
            if (as_stored->GetId(k) == as_oriented->GetId(0))
                n_turned += as_stored->GetId((k + 1) % 3) != as_oriented->GetId(1);
    }
    EXPECT_EQ(n_turned, 0);
}

TEST(Export, VtkReadsTheNetworkBack) {
    const auto snapshot = synthetic::make_aggregate(13, 42);
    const vtkNew<vtkPolyData> data = read(network_vtp(*snapshot));
    ASSERT_EQ(data->GetNumberOfLines(), static_cast<vtkIdType>(snapshot->links.size()));
    ASSERT_GT(data->GetNumberOfLines(), 12);
    std::vector<float> force_nN;
    for (const ContactLink& link : snapshot->links) force_nN.push_back(link.force_nN);
    expect_values(data->GetCellData()->GetArray("force (nN)"), force_nN, 1);
    vtkNew<vtkIdList> ends;
    data->GetCellPoints(7, ends);
    EXPECT_EQ(ends->GetId(0), snapshot->links[7].cell_a);
    EXPECT_EQ(ends->GetId(1), snapshot->links[7].cell_b);
}

TEST(Export, AFrameWithoutContactsHasAnEmptyNetwork) {
    const auto header = synthetic::make_header(1, 42);
    const auto snapshot = synthetic::make_balls(header, {{0, 0, 0}}, 9.0);
    EXPECT_EQ(read(network_vtp(*snapshot))->GetNumberOfLines(), 0);
}

TEST(Export, TheCollectionNamesEveryFileWithItsTime) {
    const std::vector<DatedFile> files{{"a.vtp", 0.0}, {"b.vtp", 0.1}};
    const std::string text = pvd_text(files);
    EXPECT_NE(text.find("timestep=\"0\" part=\"0\" file=\"a.vtp\""), std::string::npos) << text;
    EXPECT_NE(text.find("timestep=\"0.1\" part=\"0\" file=\"b.vtp\""), std::string::npos) << text;
}

}  // namespace
}  // namespace spheroscope::render
