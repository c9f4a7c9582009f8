"""A sweep: a scene over a grid of keys, and seeds. Read by the Snakefile; see README.md here."""

import csv
import itertools
import json
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

# What another try would repeat is a result, with its reason; what the machine did (no disk space, a
# signal) is not, and the run is made again by the next call.
FINISHED = {0: "finished", 2: "refused", 3: "not converged", 4: "bounds not met"}

TOTALS = ["sigma_h_core", "sigma_h_rim", "eps_YL_omega", "eps_YL_W", "coordination_Z",
          "contact_fraction", "volume_error", "n_flipped_triangles", "smallest_triangle"]


class SweepError(Exception):
    """What is wrong with the file, with its name and the key."""


@dataclass(frozen=True)
class Run:
    name: str                # folder below the sweep's: "gamma_over_omega=1,Et_over_omega=8/seed=1"
    values: dict             # axis -> value
    seed: int
    settings: tuple          # "key=value", as --set takes them


@dataclass(frozen=True)
class Sweep:
    file: Path
    scene: Path
    output: Path
    threads: int
    figures: bool
    axes: tuple
    runs: tuple


def _want(table, key, kind, where, default=None):
    if key not in table:
        if default is not None:
            return default
        raise SweepError(f"{where}: wanted '{key}', got nothing")
    value = table.pop(key)
    if not isinstance(value, kind) or isinstance(value, bool) and kind is not bool:
        raise SweepError(f"{where}: '{key}' wants {kind.__name__}, got {value!r}")
    return value


def _nothing_left(table, where):
    if table:
        raise SweepError(f"{where}: there is no key '{next(iter(table))}'")


def read(file):
    """The sweep of a TOML file. Paths in it are relative to it. Throws SweepError."""
    file = Path(file).resolve()
    try:
        table = tomllib.loads(file.read_text())
    except OSError as error:
        raise SweepError(f"{file}: {error.strerror}") from None
    except tomllib.TOMLDecodeError as error:
        raise SweepError(f"{file}: {error}") from None
    scene = (file.parent / _want(table, "scene", str, file)).resolve()
    if not scene.is_file():
        raise SweepError(f"{file}: 'scene' names {scene}, which is not there")
    output = Path(_want(table, "output", str, file))
    threads = _want(table, "threads", int, file, 2)
    figures = _want(table, "figures", bool, file, True)
    seeds = _want(table, "seeds", list, file)
    fixed = _want(table, "set", list, file, [])
    axes = []
    for number, axis in enumerate(_want(table, "axis", list, file, []), 1):
        where = f"{file}: axis {number}"
        name = _want(axis, "name", str, where)
        if not re.fullmatch(r"\w+", name):
            raise SweepError(f"{where}: 'name' wants letters, digits and _, got {name!r}")
        key = _want(axis, "key", str, where)
        values = _want(axis, "values", list, where)
        if not values or len({str(v) for v in values}) != len(values):
            raise SweepError(f"{where}: 'values' wants different values, got {values}")
        _nothing_left(axis, where)
        axes.append((name, key, values))
    _nothing_left(table, file)
    if not seeds or any(not isinstance(s, int) or s < 0 for s in seeds):
        raise SweepError(f"{file}: 'seeds' wants whole numbers from 0, got {seeds}")

    runs = []
    for point in itertools.product(*(values for _, _, values in axes)):
        values = {name: value for (name, _, _), value in zip(axes, point)}
        settings = tuple(fixed) + tuple(f"{key}={value}"
                                        for (_, key, _), value in zip(axes, point))
        setup = ",".join(f"{name}={value}" for name, value in values.items()) or "setup"
        setup = re.sub(r"[^\w=,.+-]", "_", setup)
        for seed in seeds:
            runs.append(Run(f"{setup}/seed={seed}", values, seed, settings))
    return Sweep(file, scene, output, threads, figures, tuple(name for name, _, _ in axes),
                 tuple(runs))


def reason_of(result, messages):
    """Why a run is not simply finished: its own message, the bounds that it misses, its cap; else what
    it wrote on stderr."""
    if result.get("message"):
        return result["message"]
    missed = [f"{row['measure']} = {row['value']:.4g}" for row in result.get("expectations", [])
              if not row["met"] and row["value"] is not None]
    if result.get("outcome") == "cap":
        missed.insert(0, "moved until its cap")
    return "; ".join(missed) or messages.strip()


def run_one(program, sweep, run, threads, status_file):
    """Runs one point, or goes on with it, and writes what came out, also when it failed."""
    folder = Path(status_file).parent
    command = [program, "run", str(sweep.scene), "--seed", str(run.seed), "--threads", str(threads),
               "--json", "--quiet", "--resume", "-o", str(folder)]
    for setting in run.settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in FINISHED:
        sys.stderr.write(done.stderr)
        return done.returncode if done.returncode > 0 else 1
    result = json.loads(done.stdout) if done.stdout.strip() else {}
    reason = "" if done.returncode == 0 else reason_of(result, done.stderr)
    status = {"state": FINISHED[done.returncode], "exit_code": done.returncode, "reason": reason,
              "outcome": result.get("outcome", ""), "wall_s": result.get("wall_s"),
              "threads": threads, "state_hash": result.get("state_hash"),
              "totals": result.get("totals", {}), "command": command}
    part = Path(f"{status_file}.part")
    part.write_text(json.dumps(status, indent=1))
    part.replace(status_file)
    return 0


def has_an_end(status):
    """Whether a run, from its status, came to the end of its stages: at rest, steady, after its time, or
    at its cap; also when it misses its bounds."""
    return status["outcome"] in ("rest", "stationary", "done", "cap")


def write_table(sweep, status_files, table_file):
    """One row for every run that the sweep has; returns those that failed, with their reasons."""
    failed = []
    with open(table_file, "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow([*sweep.axes, "seed", "state", "outcome", "wall_s", *TOTALS, "reason"])
        for run, status_file in zip(sweep.runs, status_files, strict=True):
            status = json.loads(Path(status_file).read_text())
            totals = status["totals"]
            table.writerow([*run.values.values(), run.seed, status["state"], status["outcome"],
                            status["wall_s"], *(totals.get(name) for name in TOTALS),
                            status["reason"]])
            if status["exit_code"] != 0:
                failed.append(f"{run.name}: {status['state']}: {status['reason']}")
    return failed
