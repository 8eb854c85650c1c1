"""Several Python threads, and Ctrl-C."""

import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import at, box_on_plate, random_poses

import glissade


def test_eight_threads_share_trees_a_simulation_and_a_pipeline(torus, ball):
    poses = random_poses(200, 0.15, seed=2)
    expected = glissade.distance(torus, ball, poses).distance
    simulation = glissade.Simulation(box_on_plate())
    pipeline = glissade.Pipeline(threads=1)
    objects = [pipeline.add(ball, at(0.2 * i, 0, 0)) for i in range(8)]

    def work(number):
        for _ in range(5):
            assert glissade.distance(torus, ball, poses).distance.tobytes() == expected.tobytes()
            simulation.follow([at(0, 0, 0.017)] * 20)
            assert len(simulation.contacts()) in (0, 4) and simulation.X_WV()[2, 3] > 0.02
            pipeline.move([objects[number]], [at(0.2 * number, 0.1, 0)])
            pipeline.step()
        return True

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(8)))
    assert simulation.wrench()[0][2] == pytest.approx(3.0, abs=0.01)


def test_other_threads_run_while_a_query_works(torus, ball):
    ticks = 0
    ends = threading.Event()

    def count():
        nonlocal ticks
        while not ends.is_set():
            ticks += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = ticks
    glissade.distance(torus, ball, random_poses(5000, 0.15, seed=6))
    during = ticks - before
    ends.set()
    counter.join()
    assert during > 2


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_a_long_query(torus, ball, threads):
    poses = np.tile(random_poses(1000, 0.15, seed=7), (300, 1, 1))
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        glissade.distance(torus, ball, poses, threads=threads)
