"""The same bits as the library in C++. GLISSADE_POSES is the number of random poses."""

import os

import numpy as np
from conftest import answers_in_cpp, at, box_on_plate, random_poses

import glissade


def test_queries_give_the_bits_of_the_library(torus, ball, tmp_path):
    poses = random_poses(int(os.environ.get("GLISSADE_POSES", 2000)), 0.15, seed=3)
    answers = answers_in_cpp("queries", poses, tmp_path)
    meets = glissade.intersects(torus, ball, poses)
    points = glissade.distance(torus, ball, poses)
    assert (meets == answers[:, 0]).all() and 0.1 < meets.mean() < 0.9
    assert points.distance.tobytes() == answers[:, 1].tobytes()
    assert (points.triangles == answers[:, 2:4]).all()
    assert points.p_A.tobytes() == answers[:, 4:7].tobytes()
    assert points.p_B.tobytes() == answers[:, 7:].tobytes()


def test_a_slide_gives_the_bits_of_the_library(tmp_path):
    ghosts = random_poses(3000, 0.0, seed=4)
    ghosts[:, :3, 3] = np.array([at(0.05 * np.sin(i / 300), 0, 0.03 - 1e-5 * i) for i in range(3000)])[:, :3]
    ghosts[:, :3, :3] = np.eye(3)
    answers = answers_in_cpp("slide", ghosts, tmp_path)
    track = glissade.Simulation(box_on_plate()).follow(ghosts)
    assert track.X_WV.reshape(-1, 16).tobytes() == np.ascontiguousarray(answers[:, :16]).tobytes()
    assert track.f_W.tobytes() == np.ascontiguousarray(answers[:, 16:]).tobytes()
    assert track.pushing.max() > 0
