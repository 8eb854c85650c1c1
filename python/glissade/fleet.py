"""Runs an assembly study on a Dask cluster: glissade-fleet STUDY [--scheduler ADDRESS].

Needs Debian's python3-distributed. The controller keeps the folder of results, and gives batches of slides to the workers.
Each worker reads the study once, by the same path as the controller. Rows depend on their number only, so the tables are
those of `glissade study`, to the byte, whatever is lost on the way.
"""

from __future__ import annotations

import argparse
import collections
import functools
import hashlib
import importlib
import json
import math
import pathlib
import socket
import sys
import time

import distributed
from distributed.scheduler import KilledWorker

import glissade

BATCH_S = 2.0  # a batch takes at least so long, so that the cost of a batch is nothing beside it
BATCH_COST_S = 3e-3  # of processor time of scheduler and controller for a batch, see bench/study/fleet_scaling.py
BUSY = 0.25  # share of the time for which many workers may keep scheduler and controller busy
LEAST_SHARE = 8  # the last batches are so many times smaller
BATCHES_AHEAD = 3  # of a worker, so that it never waits for the controller
LONGEST_BATCH = 10_000
LOST_S = 60.0  # a scheduler that comes back within this time is waited for


def batch_size(slides_left: int, slide_s: float, cores: int) -> int:
    """The slides of the next batch: more for more workers, and fewer at the end, so that all workers end together."""
    batch = max(BATCH_S, cores * BATCH_COST_S / BUSY) / slide_s
    at_the_end = max(slides_left / (2 * cores), batch / LEAST_SHARE)  # guided self-scheduling (Polychronopoulos, Kuck 1987)
    return max(1, min(LONGEST_BATCH, int(batch), math.ceil(at_the_end)))


def fingerprint_of(path: str, study: glissade.Study) -> str:
    """Differs if the study file or one of the files that it names has changed."""
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() + f"{study.input_hash(0):016x}"


@functools.lru_cache(maxsize=4)
def _study(path: str, fingerprint: str) -> glissade.Study:
    """The study of this process. Threads of a worker may read it twice at the start."""
    try:
        study = glissade.Study(path)
    except ValueError as error:
        raise ValueError(f"a worker on {socket.gethostname()}: {error}") from error
    if fingerprint_of(path, study) != fingerprint:
        raise ValueError(
            f"a worker on {socket.gethostname()}: {path}: the files or the version of Glissade differ from those of "
            "the controller"
        )
    return study


def run_batch(path: str, fingerprint: str, slides: list[int], longest_s: float) -> tuple[list[str], float]:
    """The rows of some slides, and the time that they took in seconds. Runs on a worker."""
    study = _study(path, fingerprint)
    start = time.monotonic()
    return [study.run(slide, longest_s) for slide in slides], time.monotonic() - start


class Fleet:
    """The controller of a study: what is to do, what runs, and what has come back."""

    def __init__(self, path: pathlib.Path, folder: pathlib.Path, longest_s: float = 600.0) -> None:
        self.path = str(path.resolve())
        self.study = glissade.Study(path)
        self.results = glissade.StudyResults(folder, self.study)
        self.fingerprint = fingerprint_of(self.path, self.study)
        self.longest_s = longest_s
        self.next_slide = 0
        self.again: collections.deque[list[int]] = collections.deque()  # batches that failed, in smaller pieces
        self.running: dict[distributed.Future, list[int]] = {}
        self.cost_s = BATCH_S  # of a slide; the first batches have one slide

    def run(self, connect, report=lambda fleet: None) -> dict[str, int]:
        """Runs all slides that have no row yet, and writes the tables. `connect` gives a client. If the scheduler is
        lost, it is called again."""
        lost_since = None
        while len(self.results) < len(self.study):
            try:
                with connect() as client:
                    lost_since = None
                    self._run_with(client, report)
            except (OSError, distributed.CancelledError, distributed.core.CommClosedError) as error:
                lost_since = lost_since or time.monotonic()
                if time.monotonic() - lost_since > LOST_S:
                    raise ConnectionError(f"the scheduler is lost: {error}") from error
                time.sleep(1.0)
            finally:
                self.running.clear()
                self.again.clear()
                self.next_slide = 0
        return self.results.finish()

    def _run_with(self, client: distributed.Client, report) -> None:
        finished = distributed.as_completed()
        self._submit(client, finished)
        while self.running:
            future = next(finished)
            slides = self.running.pop(future)
            if future.status == "finished":
                self._take(slides, *future.result())
            elif future.status == "error":
                self._retry(slides, future.exception())
            else:
                raise distributed.CancelledError(future.key)
            report(self)
            self._submit(client, finished)

    def _submit(self, client: distributed.Client, finished: distributed.as_completed) -> None:
        cores = max(1, sum(client.nthreads().values()))
        while len(self.running) < BATCHES_AHEAD * cores:
            slides = self._next_batch(cores)
            if not slides:
                return
            # The same batch may be tried again, so results are not shared by the names of tasks.
            future = client.submit(run_batch, self.path, self.fingerprint, slides, self.longest_s, pure=False)
            self.running[future] = slides
            finished.add(future)

    def _next_batch(self, cores: int) -> list[int]:
        if self.again:
            return self.again.popleft()
        slides_left = len(self.study) - self.next_slide
        slides = self.results.missing(self.next_slide, batch_size(slides_left, self.cost_s, cores))
        if slides:
            self.next_slide = slides[-1] + 1
        return slides

    def _take(self, slides: list[int], rows: list[str], seconds: float) -> None:
        self.cost_s = 0.8 * self.cost_s + 0.2 * max(seconds / len(slides), 1e-6)
        for slide, row in zip(slides, rows):
            self.results.add(slide, row)

    def _retry(self, slides: list[int], error: BaseException) -> None:
        """A batch whose worker died is tried slide by slide. A slide that kills its worker again has a problem."""
        if not isinstance(error, KilledWorker):
            raise error
        if len(slides) > 1:
            self.again.extend([slide] for slide in slides)
            return
        self.results.add(slides[0], self.study.not_run(slides[0], "the slide killed its worker several times"))


def _connector(scheduler: str | None, workers: int | None):
    if scheduler:
        return lambda: distributed.Client(scheduler, timeout="10s")
    cluster = distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
    return lambda: distributed.Client(cluster)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="glissade-fleet", description=__doc__.split("\n\n")[0])
    parser.add_argument("study", type=pathlib.Path, help="study file; docs/studies.md has its keys")
    parser.add_argument("--out", type=pathlib.Path, help="folder for the results, as of 'glissade study'")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="a Dask scheduler, such as tcp://host:8786; default: "
                        "a cluster on this machine")  # fmt: skip
    parser.add_argument("--workers", type=int, help="processes on this machine; default: one per processor")
    parser.add_argument("--longest-s", type=float, default=600.0, help="a slide that takes more seconds is given up")
    parser.add_argument("--quiet", action="store_true", help="show no progress")
    return parser.parse_args()


def main() -> int:
    arguments = _arguments()
    folder = arguments.out or arguments.study.with_name(arguments.study.stem + "_results")
    try:
        fleet = Fleet(arguments.study, folder, arguments.longest_s)
    except ValueError as error:
        print(f"glissade: {error}", file=sys.stderr)
        return 2
    if fleet.results.outdated:
        print(f"glissade: warning: {folder}: {fleet.results.outdated} rows belong to other inputs", file=sys.stderr)
    start, before = time.monotonic(), len(fleet.results)

    def report(fleet: Fleet) -> None:
        rate = (len(fleet.results) - before) / (time.monotonic() - start)
        print(f"\r{len(fleet.results)} of {len(fleet.study)} slides, {rate:.3g} per second ", end="", file=sys.stderr)

    connect = _connector(arguments.scheduler, arguments.workers)
    try:
        counts = fleet.run(connect, (lambda fleet: None) if arguments.quiet else report)
    except (OSError, RuntimeError, ValueError) as error:
        print(f"\nglissade: {error}. The same command goes on.", file=sys.stderr)
        return 1
    print(file=sys.stderr)
    summary = json.loads((folder / "study.json").read_text())
    interval = summary["success_rate_95_percent"]
    weighted = "with the weights of their strata, " if "strata" in summary else ""
    print(f"{counts['successes']} of {counts['slides']} slides succeed: {weighted}", end="")
    print(f"{100 * summary['success_rate']:.2f} %", end="")
    if interval:
        print(f" (95 % interval: {100 * interval[0]:.2f} % to {100 * interval[1]:.2f} %)", end="")
    if counts["problems"]:
        print(f"; {counts['problems']} could not be run, see the column 'problem'", end="")
    print()
    print(f"results: {folder / 'slides.csv'}; its page: glissade study {arguments.study} --out {folder}")
    return 0


if __name__ == "__main__":
    # Workers of another program find the functions of this module by its name only.
    sys.exit(importlib.import_module("glissade.fleet").main())
