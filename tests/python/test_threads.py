"""Several Python threads, and Ctrl-C. The thread sanitizer's lane runs these tests, so they query small meshes."""

import pathlib
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import arm, at, ball_of, box_on_plate, pressing_glove, random_poses, real_time_scene, torus_of

import glissade


@pytest.fixture(scope="module")
def torus():
    return torus_of(5000)


@pytest.fixture(scope="module")
def ball():
    return ball_of(5000)


def test_eight_threads_share_trees_a_simulation_and_a_pipeline(torus, ball, cube):
    poses = random_poses(20, 0.15, seed=2)
    expected = glissade.distance(torus, ball, poses).distance
    simulation = glissade.Simulation(box_on_plate())
    pipeline = glissade.Pipeline(threads=1)
    objects = [pipeline.add(cube, at(0.2 * i, 0, 0)) for i in range(8)]

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
    glissade.distance(torus, ball, random_poses(1000, 0.15, seed=6))
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


@pytest.mark.filterwarnings("ignore:SCHED_FIFO")
def test_eight_threads_share_a_server_and_its_gloves(tmp_path):
    """Two drive an arm, three read, two take and leave parts, and one looks at a simulated glove; a page shows it all."""
    glove, simulated = arm(), pressing_glove()
    server = glissade.HapticServer(real_time_scene(), glove, simulated, record=tmp_path / "run.lcmlog")
    ends = threading.Event()

    def drive():
        while not ends.is_set():
            glove.put(at(0, 0, 0.08))
            assert np.abs(glove.command().f_H_W).max() <= 10.0

    def read():
        ticks = []
        while not ends.is_set():
            frame = server.frame()
            ticks.append(frame.tick)
            assert np.isfinite(frame.f_W).all() and server.is_running
            assert server.statistics()["ticks"] >= frame.tick - 1  # a tick counts after its frame
        assert ticks == sorted(ticks)

    def take_and_leave():
        while not ends.is_set():
            server.release(0)
            server.grasp(0, 0)
            time.sleep(0.01)

    def look():
        times = [0.0]
        while not ends.is_set():
            times.append(simulated.script_time_s)
        assert times == sorted(times)

    with server, glissade.view(server, browser=False), ThreadPoolExecutor(8) as pool:
        jobs = [pool.submit(work) for work in [drive, drive, read, read, read, take_and_leave, take_and_leave, look]]
        try:
            while server.frame().tick < 500:
                server.run_for(0.01)
        finally:
            ends.set()
        for job in jobs:
            job.result()
    assert len(glissade.read_recording(tmp_path / "run.lcmlog").ticks) >= 500


@pytest.mark.filterwarnings("ignore:SCHED_FIFO")
def test_threads_start_and_stop_servers_at_once(tmp_path):
    for attempt in range(5):
        server = glissade.HapticServer(real_time_scene(), arm(), record=tmp_path / "log")
        together = threading.Barrier(8)

        def work(number):
            together.wait()
            try:
                server.start() if number < 4 else server.stop()
                return number < 4
            except RuntimeError as error:
                assert "starts once" in str(error)
            finally:
                server.frame()

        with ThreadPoolExecutor(8) as pool:
            assert sum(map(bool, pool.map(work, range(8)))) == 1  # one start, which a stop may have ended
        server.stop()
        assert not server.is_running


def test_a_view_shows_a_simulation_that_threads_move_and_scenes_that_they_change():
    scene = box_on_plate()
    simulation = glissade.Simulation(scene)

    def work(number):
        for _ in range(10):
            simulation.follow([at(0, 0, 0.017)] * 10)
            simulation.state()
            if number < 2:
                scene.add(f"object {len(scene.names)} of {number}", glissade.Mesh.shape("box"), at(5 + number, 0, 0))
                glissade.Simulation(scene)
        return True

    with glissade.view(simulation, browser=False), ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(8)))


def test_other_threads_run_while_a_glove_ends():
    ends = threading.Event()
    ticks = 0

    def count():
        nonlocal ticks
        while not ends.is_set():
            ticks += 1
            time.sleep(0.0001)

    interval = sys.getswitchinterval()
    counter = threading.Thread(target=count)
    counter.start()
    sys.setswitchinterval(100)  # a thread runs only when another waits
    try:
        glove = pressing_glove()
        before = ticks
        del glove
        during = ticks - before
    finally:
        sys.setswitchinterval(interval)
        ends.set()
        counter.join()
    assert during > 0
