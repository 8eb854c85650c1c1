#!/usr/bin/env python3
"""Tests run_where_quiet with programs that only write the report of one."""

import os
import pathlib
import subprocess
import tempfile
import unittest

RUNNER = pathlib.Path(__file__).with_name("run_where_quiet")

# Its case fails in the first rounds, as often as FAILS says; CASE has what else the report tells of it.
PROGRAM = """#!/usr/bin/env python3
import json, os, pathlib, sys
rounds = pathlib.Path(__file__).with_suffix(".rounds")
count = len(rounds.read_text()) if rounds.exists() else 0
rounds.write_text("x" * (count + 1))
case = {"classname": "Link", "name": "Holds", **json.loads(os.environ["CASE"])}
fails = count < int(os.environ["FAILS"])
if fails:
    case["failures"] = [{"failure": "no force"}]
report = sys.argv[2].removeprefix("--gtest_output=json:")
pathlib.Path(report).write_text(json.dumps({"testsuites": [{"testsuite": [case]}]}))
sys.exit(int(os.environ.get("STATUS", int(fails))))
"""


class RunWhereQuiet(unittest.TestCase):
    def run_program(self, **environment):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "program")
            program.write_text(PROGRAM)
            program.chmod(0o755)
            outcome = subprocess.run([RUNNER, program], stdout=subprocess.PIPE,
                                     env={**os.environ, "GLISSADE_QUIET_SECONDS": "0", **environment})
            return outcome.returncode, len(program.with_suffix(".rounds").read_text())

    def test_a_case_that_passes_runs_once(self):
        self.assertEqual(self.run_program(FAILS="0", CASE='{"stall_us": "9000"}'), (0, 1))

    def test_a_case_that_fails_on_a_quiet_machine_has_failed(self):
        self.assertEqual(self.run_program(FAILS="1", CASE='{"stall_us": "300"}'), (1, 1))

    def test_a_case_that_fails_on_a_machine_that_stalls_runs_again(self):
        self.assertEqual(self.run_program(FAILS="2", CASE='{"stall_us": "9000"}'), (0, 3))

    def test_what_no_stall_excuses_has_failed(self):
        self.assertEqual(self.run_program(FAILS="1", CASE="{}"), (1, 1))

    def test_a_program_that_stalls_a_quiet_machine_has_failed(self):
        self.assertEqual(self.run_program(FAILS="99", CASE='{"stall_us": "9000"}'), (1, 6))

    def test_a_program_that_crashes_at_its_end_has_failed(self):
        self.assertEqual(self.run_program(FAILS="0", CASE='{"stall_us": "9000"}', STATUS="139"), (1, 1))


if __name__ == "__main__":
    unittest.main()
