#!/usr/bin/env python3
"""What the scripts make of results of Google Benchmark."""

import json
import pathlib
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"


def benchmark(name, aggregate, time, **counters):
    return {"name": f"{name}_{aggregate}", "run_name": name, "aggregate_name": aggregate, "real_time": time,
            "family_index": 3, **counters}


class BenchScripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, *benchmarks):
        path = self.folder / name
        path.write_text(json.dumps({"context": {"date": "2026-01-01", "host_name": "desk"}, "benchmarks": benchmarks}))
        return path

    def run_script(self, name, *arguments):
        return subprocess.run([SCRIPTS / name, *map(str, arguments)], text=True, capture_output=True)

    def test_tidied_results_are_medians_and_spreads_of_no_machine(self):
        path = self.write("a.json", benchmark("tick/door/glissade", "mean", 2.0),
                          benchmark("tick/door/glissade", "median", 1.23456789, wrong=0),
                          benchmark("tick/door/glissade", "cv", float("nan")))
        self.assertEqual(self.run_script("bench_tidy", path).returncode, 0)
        tidied = json.loads(path.read_text())
        self.assertEqual(tidied["context"], {"date": "2026-01-01"})
        median, spread = tidied["benchmarks"]
        self.assertEqual(median, {"name": "tick/door/glissade_median", "run_name": "tick/door/glissade",
                                  "aggregate_name": "median", "real_time": 1.2346, "wrong": 0})
        self.assertNotIn("real_time", spread)  # no number is left out

    def test_comparison_has_the_mean_the_least_and_the_most_with_their_cases(self):
        old = self.write("old.json", benchmark("tick/door/glissade", "median", 1.0),
                         benchmark("tick/peg/glissade", "median", 1.0), benchmark("tick/gone/glissade", "median", 1.0))
        new = self.write("new.json", benchmark("tick/door/glissade", "median", 0.5),
                         benchmark("tick/peg/glissade", "median", 2.0))
        done = self.run_script("compare_benchmarks", old, new)
        self.assertEqual(done.stdout.splitlines()[1].split(),
                         ["tick", "glissade", "1.000", "0.500", "2.000", "door", "...", "peg"])
        self.assertIn("0.500", self.run_script("compare_benchmarks", old, new, "door").stdout)
        self.assertEqual(self.run_script("compare_benchmarks", old, new, "nothing").returncode, 1)


if __name__ == "__main__":
    unittest.main()
