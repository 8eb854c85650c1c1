"""What several tests share: boxes, gloves, random poses, and answers of the library in C++."""

import os
import subprocess

import numpy as np
import pytest

import glissade


@pytest.fixture(scope="session")
def cube():
    """The tree of a cube of 0.1 m about the origin."""
    return glissade.Tree(glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.1, size_z_m=0.1))


def torus_of(triangles):
    return glissade.Tree(glissade.Mesh.shape("torus", major_radius_m=0.08, minor_radius_m=0.03, triangles=triangles))


def ball_of(triangles):
    return glissade.Tree(glissade.Mesh.shape("sphere", radius_m=0.04, triangles=triangles))


@pytest.fixture(scope="session")
def torus():
    return torus_of(50000)


@pytest.fixture(scope="session")
def ball():
    return ball_of(50000)


def box_on_plate(**options):
    """A box of 100 x 60 x 40 mm, 10 mm above a plate at z = 0."""
    scene = glissade.Scene()
    scene.add("plate", glissade.Mesh.shape("plate", size_x_m=0.4, size_y_m=0.4, triangles=200))
    box = glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.06, size_z_m=0.04, triangles=1200)
    scene.add("box", box, at(0, 0, 0.03), movable=True, **options)
    return scene


def real_time_scene(**options):
    scene = box_on_plate(**options)
    scene.rules = glissade.SlidingRules.real_time()
    return scene


def pressing_glove():
    """Goes down in half a second, to 20 mm deeper than the plate lets the box."""
    return glissade.SimulatedGlove([0, 0.5], [at(0, 0, 0.1), at(0, 0, 0.07)])


def arm(**limits):
    """A grounded arm of 10 N at 200 Hz, with a driver in Python."""
    usual = dict(
        max_force_N=10,
        max_torque_Nm=1,
        max_stiffness_N_per_m=500,
        max_rotational_stiffness_Nm_per_rad=5,
        damping_Ns_per_m=20,
        rotational_damping_Nms_per_rad=0.1,
        update_rate_Hz=200,
    )
    return glissade.RelayGlove("arm", **{**usual, **limits})


def at(x, y, z):
    """A pose without rotation, as a row."""
    return [x, y, z, 1, 0, 0, 0]


def random_poses(count, reach, seed):
    """Matrices with random rotations, at most `reach` metres from the origin along each axis."""
    random = np.random.default_rng(seed)
    q = random.normal(size=(count, 4))
    w, x, y, z = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    poses = np.zeros((count, 4, 4))
    poses[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1)
    poses[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1)
    poses[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1)
    poses[:, :3, 3] = random.uniform(-reach, reach, size=(count, 3))
    poses[:, 3, 3] = 1
    return poses


def answers_in_cpp(kind, poses, folder):
    """The output of python_answers, a row for each pose."""
    poses.tofile(folder / "poses")
    subprocess.run([os.environ["GLISSADE_ANSWERS"], kind, folder / "poses", folder / "answers"], check=True)
    return np.fromfile(folder / "answers").reshape(len(poses), -1)
