#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

namespace spheroscope::render {

/// Triangles of closed surfaces with normals and with colours that mean something: what is drawn
/// of cells and of tubes. For the layers' own files, which may know VTK.
struct ColouredMesh {
    vtkNew<vtkFloatArray> x_um, normal;   // [nodes]
    vtkNew<vtkUnsignedCharArray> colour;  // [nodes], or [triangles]
    vtkNew<vtkTypeInt32Array> corners;    // [3 x triangles]
    vtkNew<vtkTypeInt32Array> corner_begin;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> triangles;
    vtkNew<vtkPolyData> mesh;
    vtkNew<vtkPolyDataMapper> mapper;
    vtkNew<vtkActor> actor;

    ColouredMesh() {
        x_um->SetNumberOfComponents(3);
        normal->SetNumberOfComponents(3);
        colour->SetNumberOfComponents(3);
        points->SetData(x_um);
        mesh->SetPoints(points);
        mesh->GetPointData()->SetNormals(normal);
        mapper->SetInputData(mesh);
        mapper->SetColorModeToDirectScalars();
        actor->SetMapper(mapper);
        // Shading shows the shape and must not be taken for stress: much ambient light, no
        // highlights.
        actor->GetProperty()->SetAmbient(0.40);
        actor->GetProperty()->SetDiffuse(0.60);
        actor->GetProperty()->SetSpecular(0.0);
        // Surfaces are closed and wound outward: the inner side is never seen, and half the work
        // is saved.
        actor->GetProperty()->BackfaceCullingOn();
    }

    /// When `corners` has changed.
    void connect_corners() {
        const vtkIdType n_triangles = corners->GetNumberOfValues() / 3;
        corner_begin->SetNumberOfValues(n_triangles + 1);
        for (vtkIdType i = 0; i <= n_triangles; ++i)
            corner_begin->SetValue(i, static_cast<int>(3 * i));
        triangles->SetData(corner_begin, corners);
        mesh->SetPolys(triangles);
    }

    /// When numbers have changed through pointers, of which VTK does not know.
    void mark_changed() {
        x_um->Modified();
        normal->Modified();
        colour->Modified();
        points->Modified();
        mesh->Modified();
    }
};

}  // namespace spheroscope::render
