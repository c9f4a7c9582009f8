"""What a run left, read with h5py: python3 read_run.py out/NAME/run.h5"""
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as run:
    print(f"{run.attrs['title'].decode()}: {run.attrs['n_cells']} cells, seed {run.attrs['seed']}")

    # One row for each frame; only frames that stand in /time exist.
    for time_s, area in zip(run["time"], run["diagnostics/contact_area"]):
        print(f"t = {time_s:g} s: contact area {area:g} um^2")

    # The last frame: nodes cell by cell, one number for each node, triangle or cell in a field.
    last = run[f"steps/{len(run['time']) - 1:06d}"]
    x_um = last["x"][:].reshape(run.attrs["n_cells"], run.attrs["n_nodes"], 3)
    print(f"extent {np.ptp(x_um.reshape(-1, 3), axis=0).max():g} um")
    for name, field in last["fields"].items():
        about = run["fields"][name].attrs
        print(f"{name}: mean {np.nanmean(field):g} {about['unit'].decode()}"
              f" over its {about['place'].decode()}s")

    # Contacts: force > 0 pushes the two cells apart.
    for (a, b), force_nN in zip(last["contacts/pairs"], last["contacts/force"]):
        print(f"cells {a} and {b}: {force_nN:g} nN")
