"""Compares yes-or-no queries of the module for Python with Glissade and FCL in C++: bench_python.py QUERY_TIMES [ROUNDS].

Two meshes of 50,000 triangles at 10,000 random poses. In each round, the three take turns, so that a slow time of the
machine affects all alike. Prints medians over the rounds of ratios within a round. FCL passes over every tenth pose."""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from conftest import ball_of, random_poses, torus_of  # of tests/python

import glissade

POSES, FCL_STRIDE = 10_000, 10


class InCpp:
    def __init__(self, program, X_AB, folder):
        X_AB.tofile(folder / "poses")
        self.process = subprocess.Popen([program, folder / "poses"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True)

    def answer(self, subject):
        """Seconds and number of intersecting poses of one pass."""
        print(subject, file=self.process.stdin, flush=True)
        seconds, count = self.process.stdout.readline().split()
        return float(seconds), int(count)


def main():
    program, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 21
    torus, sphere = torus_of(50_000), ball_of(50_000)
    X_AB = random_poses(POSES, 0.15, seed=3)
    of_python, of_fcl = [], []
    with tempfile.TemporaryDirectory() as folder:
        cpp = InCpp(program, X_AB, pathlib.Path(folder))
        for _ in range(rounds):
            glissade.intersects(torus, sphere, X_AB)  # caches hold these trees again
            start = time.perf_counter()
            meets = glissade.intersects(torus, sphere, X_AB)
            in_python = time.perf_counter() - start
            in_cpp, count = cpp.answer("glissade")
            fcl, fcl_count = cpp.answer(f"fcl {FCL_STRIDE}")
            assert count == meets.sum() and fcl_count == meets[::FCL_STRIDE].sum(), "the answers differ"
            of_python.append(in_python / in_cpp)
            of_fcl.append(fcl * FCL_STRIDE / in_python)
        cpp.process.stdin.close()
        cpp.process.wait()
    for text, ratios in (("Python / C++", of_python), ("FCL in C++ / Python", of_fcl)):
        q1, median, q3 = statistics.quantiles(ratios, n=4)
        print(f"{text}: median {median:.3f}, quartiles {q1:.3f} and {q3:.3f}, {len(ratios)} rounds of {POSES} poses")


if __name__ == "__main__":
    main()
