"""Several Python threads, and Ctrl-C."""

import pathlib
import signal
import subprocess
import sys
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


def test_a_signal_handler_may_ask_the_simulation_that_moves():
    simulation = glissade.Simulation(box_on_plate())
    heights = []
    signal.signal(signal.SIGALRM, lambda *_: heights.append(simulation.X_WV()[2, 3]))
    signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
    try:
        while len(heights) < 3:
            simulation.follow(np.tile(at(0, 0, 0.017), (2000, 1)))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
    assert all(0.02 < height <= 0.03 for height in heights)


@pytest.mark.parametrize("call", ["glissade.distance(ball, ball, poses)", "simulation.follow(poses)"])
def test_the_program_ends_while_a_daemon_thread_works(call):
    program = f"""
import threading, time
from conftest import *
simulation = glissade.Simulation(box_on_plate())
ball = glissade.Tree(glissade.Mesh.shape("sphere", radius_m=0.04, triangles=20000))
poses = random_poses(500, 0.05, seed=1)
poses[:, :3, :3] = np.eye(3)
def work():
    while True:
        {call}
threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", program], cwd=pathlib.Path(__file__).parent, capture_output=True)
        assert ended.returncode == 0, ended.stderr.decode()


def test_threads_share_even_a_few_long_queries(torus, ball):
    poses = random_poses(4, 0.03, seed=8)
    assert (glissade.way_out(torus, ball, poses) == glissade.way_out(torus, ball, poses, threads=4)).all()
