"""Compares yes-or-no queries of the module for Python with Glissade and FCL in C++: bench_python.py QUERY_TIMES [PAIRS].

Two meshes of 50,000 triangles at 10,000 random poses. Where the system places the memory of a process changes its speed
by a tenth, so the comparison has PAIRS pairs of processes, 21 by default. In each round of a pair, the three subjects take
turns, so that a slow time of the machine affects all alike; FCL passes over every tenth pose. Prints the median and the
quartiles over the pairs of the medians of ratios within a round."""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from conftest import ball_of, random_poses, torus_of  # of tests/python

import glissade

POSES, FCL_STRIDE, ROUNDS = 10_000, 10, 11
ONE_PAIR = "one-pair"


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


def compare(program):
    """Medians over the rounds: time of Python by time of C++, and time of FCL by time of Python."""
    torus, sphere = torus_of(50_000), ball_of(50_000)
    X_AB = random_poses(POSES, 0.15, seed=3)
    of_python, of_fcl = [], []
    with tempfile.TemporaryDirectory() as folder:
        cpp = InCpp(program, X_AB, pathlib.Path(folder))
        for _ in range(ROUNDS):
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
    return statistics.median(of_python), statistics.median(of_fcl)


def main():
    program, pairs = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "21"
    if pairs == ONE_PAIR:
        print(*compare(program))
        return
    if int(pairs) < 2:
        sys.exit("bench_python: quartiles need at least 2 pairs of processes")
    medians = []
    for _ in range(int(pairs)):
        pair = subprocess.run([sys.executable, __file__, program, ONE_PAIR], stdout=subprocess.PIPE, text=True, check=True)
        medians.append([float(ratio) for ratio in pair.stdout.split()])
    for text, ratios in zip(("Python / C++", "FCL in C++ / Python"), zip(*medians)):
        q1, median, q3 = statistics.quantiles(ratios, n=4, method="inclusive")
        print(f"{text}: median {median:.3f}, quartiles {q1:.3f} and {q3:.3f}, of {pairs} pairs of processes")


if __name__ == "__main__":
    main()
