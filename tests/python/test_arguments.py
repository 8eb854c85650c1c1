"""Wrong arguments raise an exception that names them, and nothing else happens."""

import numpy as np
import pytest
from conftest import at, box_on_plate

import glissade



def far(x):
    pose = np.eye(4)
    pose[0, 3] = x
    return pose


def with_up(up_W):
    scene = box_on_plate()
    scene.up_W = up_W
    return scene


NOT_POSES = [
    ("text", TypeError, "X_AB is an array of <U4, not of real numbers"),
    (None, TypeError, "X_AB is an array of object"),
    ([[1, 2], [3]], TypeError, "X_AB is no array of numbers"),
    (np.zeros(7, dtype=complex), TypeError, "complex128"),
    (np.zeros(7, dtype=bool), TypeError, "bool"),
    (1.0, ValueError, "X_AB has the shape ()"),
    (np.zeros((3, 5)), ValueError, "X_AB has the shape (3, 5), but poses have the shape"),
    ([0, 0, np.nan, 1, 0, 0, 0], ValueError, "X_AB has a number that is not finite"),
    ([at(0, 0, 0), [0, 0, 0, 2, 0, 0, 0]], ValueError, "X_AB[1]: the quaternion (w x y z) 2 0 0 0 has length 2"),
    ([at(0, 0, 0), [0, 0, np.inf, 1, 0, 0, 0]], ValueError, "X_AB[1] has a number that is not finite"),
    (2 * np.eye(4), ValueError, "X_AB: the last row of a pose is 0, 0, 0, 1"),
    (np.diag([1, 1, -1, 1]), ValueError, "reflection"),
    (np.diag([2, 2, 2, 1]), ValueError, "rotation"),
    (np.diag([1.0002, 1, 1, 1]), ValueError, "rotation"),
    ([1e160, 0, 0, 1, 0, 0, 0], ValueError, "X_AB: the position 1e+160 is beyond 1e9 m"),
    (far(1e160), ValueError, "X_AB: the position 1e+160 is beyond 1e9 m"),
    (far(-2e9), ValueError, "X_AB: the position -2e+09 is beyond 1e9 m"),
]


@pytest.mark.parametrize("poses, error, sentence", NOT_POSES)
def test_poses(cube, poses, error, sentence):
    for query in [glissade.intersects, glissade.pairs, glissade.distance, glissade.way_out]:
        with pytest.raises(error) as caught:
            query(cube, cube, poses)
        assert sentence in str(caught.value)


def test_a_pose_of_an_array_with_two_axes_is_named(cube):
    poses = [[at(0, 0, 0)], [[0, 0, np.inf, 1, 0, 0, 0]]]
    with pytest.raises(ValueError, match=r"^X_AB\[1, 0\] has a number that is not finite"):
        glissade.intersects(cube, cube, poses)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_every_number_of_a_matrix_must_be_finite(cube, value):
    for entry in np.ndindex(4, 4):
        pose = np.eye(4)
        pose[entry] = value
        with pytest.raises(ValueError, match="^X_AB has a number that is not finite"):
            glissade.intersects(cube, cube, pose)


def test_a_pose_among_many_is_named(cube):
    poses = np.tile(np.eye(4), (1000, 1, 1))
    poses[[700, 990], 0, 0] = 3
    for threads in [1, 4]:
        with pytest.raises(ValueError, match=r"^X_AB\[700\] "):
            glissade.intersects(cube, cube, poses, threads=threads)


def test_arrays_of_any_stride_type_and_order_are_read(cube):
    poses = np.tile(np.eye(4), (6, 1, 1))
    poses[:, 0, 3] = np.arange(6) * 0.04
    expected = [True, True, True, False, False, False]
    read_only = poses.copy()
    read_only.flags.writeable = False
    big_endian = poses.astype(">f8")
    transposed = np.asfortranarray(poses)
    for same in [read_only, big_endian, transposed, poses.astype(np.float32), poses.tolist()]:
        assert glissade.intersects(cube, cube, same).tolist() == expected
    assert glissade.intersects(cube, cube, poses[::-1]).tolist() == expected[::-1]
    assert glissade.intersects(cube, cube, poses[::2]).tolist() == expected[::2]


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda cube: glissade.intersects(cube, cube, at(0, 0, 0), tolerance=-1.0), "tolerance or distance is negative"),
        (lambda cube: glissade.intersects(cube, cube, at(0, 0, 0), threads=0), "threads must be between 1 and 1024, not 0"),
        (lambda cube: glissade.way_out(cube, cube, at(0, 0, 0), clearance=np.inf), "clearance of a way out is not between"),
        (lambda cube: glissade.Pipeline(threads=100_000), "cannot have 100000 threads, but 0 to 1024"),
        (lambda cube: glissade.Mesh([[0, 0, 0]], [[0, 1, 2]]), "triangles[0] has the index 1, but there are 1 vertices"),
        (lambda cube: glissade.Mesh([[0, 0]], [[0, 0, 0]]), "vertices must have the shape (n, 3)"),
        (lambda cube: glissade.Tree(glissade.Mesh(np.zeros((3, 3)), [[0, 1, 2]])), "triangle"),
        (lambda cube: glissade.Mesh.read("/nowhere.stl"), "/nowhere.stl: there is no such file"),
        (lambda cube: glissade.Mesh.shape("bax"), "bax"),
        (lambda cube: glissade.Mesh.shape("box", x=1.0), "has no parameter 'x'"),
        (lambda cube: glissade.HandShape(side="both"), "side must be 'right' or 'left', not 'both'"),
        (lambda cube: glissade.Posture(at(0, 0, 0), np.zeros(21)), "angles must have the shape (22,)"),
        (lambda cube: glissade.Posture(at(0, 0, 0), np.full(22, np.nan)), "angles has a number that is not finite"),
        (lambda cube: glissade.Simulation(box_on_plate()).advance(at(0, 0, 0), np.nan), "milliseconds must be finite"),
        (lambda cube: glissade.Simulation(box_on_plate()).follow([at(0, 0, 0)], -1.0), "milliseconds must be finite"),
        (lambda cube: glissade.Scene.parse("objects: 3", "mine.yaml"), "mine.yaml"),
        (lambda cube: glissade.Scene().add("a", glissade.Mesh.shape("box"), motion=([0, 1], [at(0, 0, 0)])), "motion"),
        (lambda cube: glissade.Simulation(glissade.Scene()), "no object is movable"),
        (lambda cube: glissade.Simulation(with_up([np.nan, 0, 0])), "the direction against gravity must be a unit vector"),
        (lambda cube: glissade.Mesh(np.zeros((3, 3)), np.array([[0, 1, 2**64 - 1]], dtype=np.uint64)), "18446744073709551615"),
        (lambda cube: glissade.Simulation(box_on_plate()).advance([at(0, 0, 0)] * 2), "2 poses for 1 part"),
        (lambda cube: glissade.Simulation(box_on_plate()).follow(at(0, 0, 0)), "X_WG must have the shape (n, 7)"),
        (lambda cube: glissade.Simulation(box_on_plate()).advance_hands([None]), "1 posture for 0 hands"),
    ],
)
def test_values(cube, call, sentence):
    with pytest.raises(ValueError) as caught:
        call(cube)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: glissade.Mesh.shape("box", size_x_m="a"), "size_x_m is no number"),
        (lambda: glissade.Mesh.read(5), "expected str, bytes or os.PathLike object, not int"),
        (lambda: glissade.Scene().add("a", glissade.Mesh.shape("box"), motion=5), "motion must be the times and the poses"),
        (lambda: glissade.Simulation(box_on_plate()).X_WV(-1), "X_WV"),
    ],
)
def test_types(call, sentence):
    with pytest.raises(TypeError) as caught:
        call()
    assert sentence in str(caught.value)


def test_names_of_files_need_not_be_text():
    with pytest.raises(ValueError, match=r"/no\\xff.stl: there is no such file"):
        glissade.Mesh.read(b"/no\xff.stl")


def test_a_warning_names_the_line_that_read_the_mesh(tmp_path):
    (tmp_path / "mesh.obj").write_text("8 12\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "scene.yaml").write_text("objects:\n- {name: a, mesh: mesh.obj}\n- {name: b, mesh: mesh.obj}\n")
    for read in [lambda: glissade.Mesh.read(tmp_path / "mesh.obj"), lambda: glissade.Scene.read(tmp_path / "scene.yaml")]:
        with pytest.warns(UserWarning, match="1 unknown statement is skipped") as caught:
            read()
        assert caught[0].filename == __file__


@pytest.mark.parametrize(
    "wrong, sentence",
    [
        (None, "tree{} is no Tree but of type NoneType"),
        (np.eye(4), "tree{} is no Tree but of type ndarray"),
        (glissade.Mesh.shape("box"), "tree{} is a Mesh; build a tree of it first, once for all queries: glissade.Tree(mesh)"),
    ],
)
def test_what_is_no_tree_is_named(cube, wrong, sentence):
    def raises(name, call):
        with pytest.raises(TypeError) as caught:
            call()
        assert str(caught.value) == sentence.format(name)

    for query in [glissade.intersects, glissade.pairs, glissade.distance, glissade.way_out]:
        raises("_A", lambda query=query: query(wrong, cube, at(0, 0, 0)))
        raises("_B", lambda query=query: query(cube, wrong, at(0, 0, 0)))
    raises("_A", lambda: glissade.pairs_within(wrong, cube, at(0, 0, 0), 0.1))
    raises("", lambda: glissade.Pipeline(threads=1).add(wrong))


def test_arrays_that_no_memory_holds(cube):
    huge = np.broadcast_to(np.float64(0), (2**45, 7))  # 2 PB, of which 8 bytes exist
    with pytest.raises(MemoryError):
        glissade.intersects(cube, cube, huge)
    with pytest.raises(MemoryError):
        glissade.Mesh([[0, 0, 0]], np.broadcast_to(np.int32(0), (2**45, 3)))


def test_parts_and_hands_that_do_not_exist():
    simulation = glissade.Simulation(box_on_plate())
    for wrong in [lambda: simulation.X_WV(1), lambda: simulation.wrench(9), lambda: simulation.grasp()]:
        with pytest.raises(IndexError, match="there is no"):
            wrong()
    with pytest.raises(TypeError):
        simulation.X_WV(-1)


def test_random_arguments_raise_or_answer(cube):
    random = np.random.default_rng(5)
    shapes = [(), (0,), (1,), (7,), (4, 4), (2, 7), (3, 4, 4), (2, 3, 7), (0, 4, 4), (7, 0), (16,), (1, 1, 1, 1, 7)]
    kinds = [np.float64, np.float32, np.int8, np.uint64, complex, bool, object, "U3", "M8[s]"]
    values = [np.nan, np.inf, -np.inf, 1e300, -1e9, 0, 1, 5e-324]
    answered = 0
    for _ in range(2000):
        shape = shapes[random.integers(len(shapes))]
        with np.errstate(all="ignore"):
            array = np.array(random.choice(values, size=shape)).astype(np.float64)
            if array.ndim and array.shape[-1] == 7 and random.integers(2):
                array[..., 3:] = [1, 0, 0, 0]
            try:
                array = array.astype(kinds[random.integers(len(kinds))])
            except (ValueError, OverflowError):
                continue
        try:
            glissade.distance(cube, cube, array, threads=int(random.integers(1, 4)))
            answered += 1
        except (ValueError, TypeError):
            pass
    assert answered > 0
