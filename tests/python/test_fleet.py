"""Studies on a Dask cluster: the same rows as without, whatever is lost."""

import os
import pathlib
import signal
import socket
import subprocess
import sys

import pytest
from test_study import PATH, SCENE, STUDY

import glissade

distributed = pytest.importorskip("distributed")
from glissade import fleet  # noqa: E402

SLIDES = 60


@pytest.fixture
def file(tmp_path: pathlib.Path) -> pathlib.Path:
    (tmp_path / "scene.yaml").write_text(SCENE)
    (tmp_path / "path.csv").write_text(PATH)
    (tmp_path / "study.yaml").write_text(STUDY.replace("slides: 20", f"slides: {SLIDES}"))
    return tmp_path / "study.yaml"


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster


@pytest.fixture
def small_batches(monkeypatch):
    monkeypatch.setattr(fleet, "LONGEST_BATCH", 3)


def rows_of(folder: pathlib.Path) -> list[str]:
    return (folder / "slides.jsonl").read_text().splitlines()


def expected_rows(file: pathlib.Path) -> list[str]:
    study = glissade.Study(file)
    return [study.run(slide) for slide in range(len(study))]


def test_a_cluster_gives_the_rows_of_one_process(file, cluster):
    controller = fleet.Fleet(file, file.parent / "out")
    counts = controller.run(lambda: distributed.Client(cluster))
    assert counts["slides"] == SLIDES and counts["problems"] == 0
    assert rows_of(file.parent / "out") == expected_rows(file)


def test_batches_grow_with_the_cluster_and_shrink_at_the_end():
    slide_s = 0.05
    assert fleet.batch_size(1_000_000, slide_s, 2) == 40, "two seconds"
    of_many = fleet.batch_size(1_000_000, slide_s, 1000)
    assert 1000 * fleet.BATCH_COST_S / (of_many * slide_s) == pytest.approx(fleet.BUSY, rel=0.01)
    assert fleet.batch_size(16, slide_s, 2) == 5, "the least share of a batch"
    assert fleet.batch_size(100, slide_s, 2) == 25, "half of what is left for each worker"
    assert fleet.batch_size(1000, 100.0, 2) == 1


def test_a_killed_worker_changes_no_row(file, cluster, small_batches):
    controller = fleet.Fleet(file, file.parent / "out")
    killed = []

    def kill_once(running):
        if not killed and len(running.results) > 5:
            killed.append(next(iter(cluster.workers.values())).pid)
            os.kill(killed[0], signal.SIGKILL)

    controller.run(lambda: distributed.Client(cluster), kill_once)
    assert killed
    assert rows_of(file.parent / "out") == expected_rows(file)


def test_an_interrupted_study_goes_on(file, cluster, small_batches):
    class Interrupted(Exception):
        pass

    def interrupt(running):
        if len(running.results) > 20:
            raise Interrupted

    with pytest.raises(Interrupted):
        fleet.Fleet(file, file.parent / "out").run(lambda: distributed.Client(cluster), interrupt)
    again = fleet.Fleet(file, file.parent / "out")
    assert 20 < len(again.results) < SLIDES
    again.run(lambda: distributed.Client(cluster))
    assert rows_of(file.parent / "out") == expected_rows(file)


def test_a_slide_that_kills_its_worker_has_a_problem(file):
    controller = fleet.Fleet(file, file.parent / "out")
    killed = fleet.KilledWorker("a task", None, 3)
    controller._retry([4, 5], killed)
    assert list(controller.again) == [[4], [5]]
    controller._retry([4], killed)
    assert 4 not in controller.results.missing(0, SLIDES)
    with pytest.raises(ZeroDivisionError):
        controller._retry([5], ZeroDivisionError())


def test_other_files_at_a_worker_are_told(file):
    fleet._study.cache_clear()
    with pytest.raises(ValueError, match="differ from those of the controller"):
        fleet.run_batch(str(file), "another", [0], 1.0)


class Scheduler:
    """A scheduler in a process of its own, with one worker."""

    def __init__(self, port: int) -> None:
        self.address = f"tcp://127.0.0.1:{port}"
        self.processes = [self.start("scheduler", "--port", str(port), "--no-dashboard")]
        self.processes.append(self.start("worker", self.address, "--no-dashboard", "--nthreads", "1"))

    @staticmethod
    def start(program: str, *arguments: str) -> subprocess.Popen:
        command = [sys.executable, "-m", f"distributed.cli.dask_{program}", *arguments]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


def test_the_command_uses_workers_of_another_program(file):
    scheduler = Scheduler(free_port())
    try:
        command = [sys.executable, "-m", "glissade.fleet", str(file), "--scheduler", scheduler.address, "--quiet"]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=120)
    finally:
        scheduler.kill()
    assert ended.returncode == 0, ended.stderr
    assert f"of {SLIDES} slides succeed" in ended.stdout
    assert rows_of(file.parent / "study_results") == expected_rows(file)


def test_a_scheduler_that_is_killed_and_started_again_loses_nothing(file, small_batches):
    port = free_port()
    schedulers = [Scheduler(port)]

    def restart_once(running):
        if len(schedulers) == 1 and len(running.results) > 5:
            schedulers[0].kill()
            schedulers.append(Scheduler(port))

    try:
        connect = lambda: distributed.Client(schedulers[0].address, timeout="5s")  # noqa: E731
        fleet.Fleet(file, file.parent / "out").run(connect, restart_once)
    finally:
        for scheduler in schedulers:
            scheduler.kill()
    assert len(schedulers) == 2
    assert rows_of(file.parent / "out") == expected_rows(file)
