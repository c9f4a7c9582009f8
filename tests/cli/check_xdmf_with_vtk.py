"""Run by ParaView's pvpython: both readers that VTK has for XDMF must give back what h5py reads.

Each time of the run once (frames of one time, such as those of the packing, are one to VTK).
"""
import sys

import h5py
import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

folder = sys.argv[1]
readers = (simple.XDMFReader(FileNames=[folder + "/run.xdmf"]),
           simple.Xdmf3ReaderT(FileName=[folder + "/run.xdmf"]))
with h5py.File(folder + "/run.h5") as run:
    steps = [run["steps"][name] for name in sorted(run["steps"])]
    times_s = [float(step.attrs["time_s"]) for step in steps]
    triangles = run["topology/triangles"][:]
    n_arrays = 0
    for reader in readers:
        reader.UpdatePipelineInformation()
        assert np.allclose(reader.TimestepValues, sorted(set(times_s))), reader.TimestepValues
        for step, time_s in zip(steps, times_s):
            if times_s.count(time_s) > 1:
                continue
            reader.UpdatePipeline(time_s)
            mesh = servermanager.Fetch(reader)
            assert np.array_equal(vtk_to_numpy(mesh.GetPoints().GetData()), step["x"][:])
            cells = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(-1, 3)
            assert np.array_equal(cells, triangles)
            for data in (mesh.GetPointData(), mesh.GetCellData()):
                for i in range(data.GetNumberOfArrays()):
                    name = data.GetArrayName(i).split(" ")[0]
                    stored = step[name] if name in step else step["fields"][name]
                    assert np.array_equal(vtk_to_numpy(data.GetArray(i)), stored[:], equal_nan=True), name
                    n_arrays += 1
print(n_arrays)
