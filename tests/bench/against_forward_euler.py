#!/usr/bin/env python3
"""Wall time and error of methods at the end of a relaxation, against forward Euler with the paper's step.

    tests/bench/against_forward_euler.py [PROGRAM [DURATION [NODES]]]

Runs scenes/bench/ball_13.toml (13 cells, E = 20 kPa, omega = 0.5 nN/um) on one thread, row by row, into
out/against_forward_euler, and prints how much faster each row is than the first, with the difference of
its end: contact area, hydrostatic stress (RMS over cells over the RMS of the first row's), and whether
the same cells touch. The last row is the first with half the step: what the reference itself scatters.
After 160 s the cells are at rest; 30 s, the default, end on the way there. Rows of less than ten seconds
are run three times, and the quickest counts.
"""
import shutil
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(HERE.parent.parent / "build" / "spheroscope")
DURATION = sys.argv[2] if len(sys.argv) > 2 else "30 s"
NODES = sys.argv[3] if len(sys.argv) > 3 else "642"
OUT = Path("out/against_forward_euler")


def forward_euler(step):
    return f"forward_euler, {step}", ["method.name=forward_euler", f"method.dt={step}"]


def implicit(tolerance, bound, longest, linear="1e-3", name="linearly_implicit"):
    return (f"{name}, {tolerance}, {bound} h0, {longest}",
            [f"method.name={name}", f"method.tolerance={tolerance}", f"method.displacement_bound={bound}",
             f"method.dt_max={longest}", "method.dt=20 ms", f"method.linear_tolerance={linear}"])


ROWS = [
    forward_euler("3.85 ms"),
    forward_euler("15.4 ms"),
    forward_euler("30 ms"),
    forward_euler("45 ms"),
    implicit("6 nm", 0.5, "0.5 s"),
    implicit("10 nm", 0.5, "0.5 s"),
    implicit("20 nm", 0.5, "1 s"),
    implicit("60 nm", 1, "2 s", "2e-3"),
    implicit("6 nm", 0.5, "2 s"),
    implicit("20 nm", 1, "5 s", "2e-3"),
    forward_euler("1.925 ms"),
]


def end_of(number, changes):
    """Runs a row; returns wall time in s, contact area, sigma_h of the cells, touching pairs; None if it failed."""
    folder = OUT / str(number)
    shutil.rmtree(folder, ignore_errors=True)
    command = [PROGRAM, "run", str(HERE.parent.parent / "scenes/bench/ball_13.toml"), "-o", str(folder),
               "--quiet", "--threads", "1", "--set", 'measures.fields=["sigma_h"]',
               "--set", "measures.time_error=false"]
    for change in [f"cells.nodes={NODES}", f"stage[0].duration={DURATION}", f"stage[0].every={DURATION}", *changes]:
        command += ["--set", change]
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    wall_s = time.monotonic() - begin
    if done.returncode != 0:
        return None
    with h5py.File(folder / "run.h5") as file:
        last = file["steps"][sorted(file["steps"])[-1]]
        return (wall_s, file["diagnostics/contact_area"][-1], last["fields/sigma_h"][:],
                {tuple(pair) for pair in last["contacts/pairs"][:]})


def main():
    reference = None
    print(f"{'method':44} {'wall s':>8} {'faster':>7} {'area':>9} {'sigma_h':>8}  same contacts")
    for number, (name, changes) in enumerate(ROWS):
        end = end_of(number, changes)
        if end is not None and end[0] < 10.0:
            end = min((end, end_of(number, changes), end_of(number, changes)), key=lambda e: e[0])
        if end is None:
            print(f"{name:44} stopped: unstable")
            continue
        reference = reference or end
        wall_s, area, sigma, pairs = end
        error = np.sqrt(np.mean((sigma - reference[2]) ** 2) / np.mean(reference[2] ** 2))
        print(f"{name:44} {wall_s:8.2f} {reference[0] / wall_s:6.1f}x {100 * (area / reference[1] - 1):+8.3f}% "
              f"{100 * error:7.2f}%  {'yes' if pairs == reference[3] else 'no'}", flush=True)


if __name__ == "__main__":
    main()
