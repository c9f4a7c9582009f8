"""A sweep from its file to its table: what is read, what failed runs leave, what a second call does.

  sweep_test.py              the parts, with a made-up program
  sweep_test.py PROGRAM      a sweep through Snakemake with the real one, here and by a made-up sbatch
"""

import csv
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scenes" / "sweeps"))
import sweep as sweeps  # noqa: E402

PROGRAM = None

SCENE = (ROOT / "scenes" / "bench" / "ball_13.toml").as_posix()
TEXT = f"""
scene = "{SCENE}"
output = "out"
seeds = [1, 2]
threads = 1
figures = false
set = ["cells.nodes=42"]

[[axis]]
name = "E"
key = "cortex.elastic.E"
values = ["20 kPa", "-1 kPa"]
"""

AXES_TEXT = f"""
scene = "{(ROOT / "scenes" / "tour" / "first_light.toml").as_posix()}"
output = "out"
seeds = [1]
threads = 1
set = ["cells.nodes=42", "stage[0].frames=2", "stage[0].packing_fraction=0.3"]

[[axis]]
name = "N"
key = "cells.count"
values = [6, 8]

[[axis]]
name = "law"
key = "contact.law"
values = ["traction", "variational"]
"""


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path


class Reading(InFolder):
    def test_every_point_of_the_grid_and_every_seed_is_a_run(self):
        sweep = sweeps.read(self.file("s.toml", TEXT))
        self.assertEqual([run.name for run in sweep.runs],
                         ["E=20_kPa/seed=1", "E=20_kPa/seed=2", "E=-1_kPa/seed=1", "E=-1_kPa/seed=2"])
        self.assertEqual(sweep.runs[0].settings, ("cells.nodes=42", "cortex.elastic.E=20 kPa"))

    def test_sweeps_of_the_project_can_be_read(self):
        grid = sweeps.read(ROOT / "scenes" / "sweeps" / "paper_grid.sweep")
        self.assertEqual(len(grid.runs), 5 * 6 * 5)

    def test_any_key_of_a_scene_can_be_an_axis(self):
        sweep = sweeps.read(self.file("s.toml", AXES_TEXT))
        self.assertEqual([run.name for run in sweep.runs],
                         ["N=6,law=traction/seed=1", "N=6,law=variational/seed=1",
                          "N=8,law=traction/seed=1", "N=8,law=variational/seed=1"])
        self.assertEqual(sweep.runs[3].settings[-2:], ("cells.count=8", "contact.law=variational"))
        self.assertTrue(sweep.figures)

    def test_the_reason_is_the_message_or_what_was_missed(self):
        missed = {"outcome": "cap", "expectations": [
            {"measure": "virial_defect", "value": 0.0123, "met": False},
            {"measure": "n_folds", "value": 0, "met": True}]}
        self.assertEqual(sweeps.reason_of(missed, "warning: much"),
                         "moved until its cap; virial_defect = 0.0123")
        self.assertEqual(sweeps.reason_of({"message": "unstable", **missed}, ""), "unstable")
        self.assertEqual(sweeps.reason_of({}, "error: no such scene\n"), "error: no such scene")

    def test_runs_without_an_end_are_not_drawn(self):
        self.assertTrue(sweeps.has_an_end({"outcome": "cap"}))
        self.assertTrue(sweeps.has_an_end({"outcome": "rest"}))
        for outcome in ("", "unstable", "not packed", "stopped", "time limit"):
            self.assertFalse(sweeps.has_an_end({"outcome": outcome}))

    def test_mistakes_name_file_and_key(self):
        for text, words in [
            (TEXT.replace("seeds", "seed"), "wanted 'seeds'"),
            (TEXT + "nonsense = 1\n", "no key 'nonsense'"),
            (TEXT.replace("[1, 2]", "[-1]"), "'seeds' wants whole numbers"),
            (TEXT.replace("[1, 2]", "[]"), "'seeds' wants whole numbers"),
            (TEXT.replace('["20 kPa", "-1 kPa"]', "[]"), "'values' wants different values"),
            (TEXT.replace("ball_13", "ball_14"), "not there"),
            (TEXT.replace('"20 kPa", "-1 kPa"', '"1", "1"'), "different values"),
            (TEXT.replace("threads = 1", 'threads = "two"'), "'threads' wants int"),
            ("scene = ", "s.toml"),
        ]:
            with self.subTest(words), self.assertRaises(sweeps.SweepError) as caught:
                sweeps.read(self.file("s.toml", text))
            self.assertIn(words, str(caught.exception))
            self.assertIn("s.toml", str(caught.exception))


class Running(InFolder):
    def run_with(self, script):
        program = self.file("program", "#!/bin/sh\n" + script)
        program.chmod(0o755)
        sweep = sweeps.read(self.file("s.toml", TEXT))
        return sweep, sweeps.run_one(str(program), sweep, sweep.runs[0], 1,
                                     self.folder / "status.json")

    def test_a_failed_run_is_in_the_table_with_its_reason(self):
        sweep, code = self.run_with("""echo '{"message": "cell 3, edge 7", "totals": {}}'; exit 3""")
        self.assertEqual(code, 0)
        failed = sweeps.write_table(sweep, [self.folder / "status.json"] * 4, self.folder / "t.csv")
        self.assertEqual(len(failed), 4)
        self.assertIn("not converged: cell 3, edge 7", failed[0])
        with open(self.folder / "t.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["reason"] for row in rows], ["cell 3, edge 7"] * 4)

    def test_what_the_machine_did_is_no_result(self):
        for code in 5, 130, 143:
            _, got = self.run_with(f"echo disk full >&2; exit {code}")
            self.assertEqual(got, code)
            self.assertFalse((self.folder / "status.json").exists())

    def test_a_missing_run_is_not_left_out_of_the_table(self):
        sweep, _ = self.run_with("echo '{}'")
        with self.assertRaises(ValueError):
            sweeps.write_table(sweep, [self.folder / "status.json"] * 3, self.folder / "t.csv")


class ThroughSnakemake(InFolder):
    def setUp(self):
        super().setUp()
        if PROGRAM is None:
            self.skipTest("no program given")
        self.sweep = self.file("s.toml", TEXT)

    def call(self, *arguments, path=""):
        return subprocess.run(
            ["snakemake", "-s", str(ROOT / "scenes" / "sweeps" / "Snakefile"), *arguments,
             "--directory", str(self.folder), "--config", f"sweep={self.sweep}",
             f"program={PROGRAM}", f"output={self.folder / 'out'}"],
            cwd=ROOT, env={**os.environ, "PATH": path + os.environ["PATH"]}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def rows(self):
        with open(self.folder / "out" / "runs.csv") as file:
            return list(csv.DictReader(file))

    def test_failed_runs_are_listed_and_only_what_is_missing_is_made_again(self):
        done = self.call("--cores", "1")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("2 of 4 runs finished", done.stdout)
        rows = self.rows()
        self.assertEqual([row["state"] for row in rows], ["finished"] * 2 + ["refused"] * 2)
        self.assertIn("cortex.elastic.E", rows[2]["reason"])
        self.assertGreater(float(rows[0]["coordination_Z"]), 0.0)

        lost = self.folder / "out" / "E=20_kPa" / "seed=2" / "status.json"
        kept = self.folder / "out" / "E=20_kPa" / "seed=1" / "status.json"
        before = kept.stat().st_mtime_ns
        lost.unlink()
        self.assertEqual(self.call("--cores", "1").returncode, 0)
        self.assertTrue(lost.exists())
        self.assertEqual(kept.stat().st_mtime_ns, before)

    def test_numbers_of_cells_and_laws_of_contact_are_swept_and_drawn(self):
        # first light until its compaction, for seconds
        scene = (ROOT / "scenes" / "tour" / "first_light.toml").read_text()
        until = scene.index('[[stage]]\nkind = "hold"')
        short = scene[:until].replace("5 s", "0.5 s")
        short_scene = self.file("short.toml", short)
        self.sweep.write_text(AXES_TEXT.replace(
            (ROOT / "scenes" / "tour" / "first_light.toml").as_posix(), short_scene.as_posix()))
        done = self.call("--cores", "1")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("4 of 4 runs finished", done.stdout)
        rows = self.rows()
        self.assertEqual([(row["N"], row["law"]) for row in rows],
                         [("6", "traction"), ("6", "variational"),
                          ("8", "traction"), ("8", "variational")])
        # the law is that of the run and not a name alone
        self.assertNotEqual(rows[0]["contact_fraction"], rows[1]["contact_fraction"])
        figures = self.folder / "out" / "figures"
        self.assertGreater((figures / "fig3.png").stat().st_size, 10000)
        with open(figures / "numbers.csv") as file:
            numbers = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual(len({row["setup"] for row in numbers}), 4)

    def test_the_profile_for_slurm_sends_every_run_as_a_job(self):
        stubs = self.folder / "stubs"
        stubs.mkdir()
        for name, script in [
            ("sbatch", f'echo "$@" >> {self.folder}/calls; for job; do :; done\n'
                       'sh "$job" >/dev/null 2>&1; echo 17'),
            ("scontrol", "echo JobState=COMPLETED"), ("sacct", "exit 1"),
        ]:
            (stubs / name).write_text("#!/bin/bash\n" + script + "\n")
            (stubs / name).chmod(0o755)
        profile = self.folder / "profile"
        shutil.copytree(ROOT / "scenes" / "sweeps" / "slurm", profile)
        config = (profile / "config.yaml").read_text()
        status = "scenes/sweeps/slurm/status"
        self.assertIn(status, config)
        (profile / "config.yaml").write_text(config.replace(status, str(ROOT / status)))
        done = self.call("--profile", str(profile), path=f"{stubs}:")
        self.assertEqual(done.returncode, 0, done.stdout)
        calls = (self.folder / "calls").read_text().splitlines()
        self.assertEqual(len(calls), 4)
        for call in calls:
            self.assertIn("--cpus-per-task=1 --mem=1000M --time=60", call)
        self.assertEqual(len(self.rows()), 4)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        PROGRAM = sys.argv.pop(1)
    unittest.main()
