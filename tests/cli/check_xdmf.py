"""Every array that an XDMF file names must be a dataset of that shape and type in the HDF5 file."""
import os
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

path = sys.argv[1]
grids = ElementTree.parse(path).getroot().findall(".//Grid[@GridType='Uniform']")
n_items = 0
for grid in grids:
    for item in grid.iter("DataItem"):
        name, dataset = item.text.split(":")
        with h5py.File(os.path.join(os.path.dirname(path), name)) as run:
            shape = tuple(int(n) for n in item.get("Dimensions").split())
            kind = {"Float": np.floating, "Int": np.integer}[item.get("NumberType")]
            values = run[dataset]
            assert values.shape == shape, (dataset, values.shape, shape)
            assert np.issubdtype(values.dtype, kind) and values.dtype.itemsize == 4, dataset
        n_items += 1
print(len(grids), n_items)
