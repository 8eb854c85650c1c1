"""Queries against closed forms, and every way to ask the same."""

import numpy as np
import pytest
from conftest import at, random_poses

import glissade


def test_two_cubes_meet_where_their_faces_touch(cube):
    assert glissade.intersects(cube, cube, at(0.1, 0, 0)) is True
    assert glissade.intersects(cube, cube, at(np.nextafter(0.1, 1), 0, 0)) is False
    assert glissade.intersects(cube, cube, at(0.102, 0, 0), tolerance=0.0021) is True


def test_the_distance_of_two_cubes_is_that_of_their_faces(cube):
    points = glissade.distance(cube, cube, [at(0.15, 0, 0), at(0.05, 0, 0), at(0, 0, 0.3)])
    np.testing.assert_allclose(points.distance, [0.05, 0, 0.2], atol=1e-15)
    np.testing.assert_allclose((points.p_B - points.p_A)[0], [0.05, 0, 0], atol=1e-15)
    np.testing.assert_allclose((points.p_B - points.p_A)[2], [0, 0, 0.2], atol=1e-15)
    assert np.isnan(points.p_A[1]).all() and (points.triangles[1] == -1).all()
    assert (points.triangles[[0, 2]] >= 0).all()


def test_a_limit_is_the_answer_where_nothing_is_nearer(cube):
    points = glissade.distance(cube, cube, at(0.15, 0, 0), limit=0.01)
    assert points.distance == 0.01 and np.isnan(points.p_A).all()


def test_pairs_of_triangles_are_those_that_brute_force_finds(cube):
    one = glissade.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    crossing = glissade.Mesh(
        [[0.2, 0.2, -1], [0.2, 0.2, 1], [0.3, 0.3, 1], [5, 5, 5], [6, 5, 5], [5, 6, 5]], [[3, 4, 5], [0, 1, 2]]
    )
    pairs = glissade.pairs(glissade.Tree(one), glissade.Tree(crossing), at(0, 0, 0))
    assert pairs.tolist() == [[0, 1]]
    near = glissade.pairs_within(glissade.Tree(one), glissade.Tree(crossing), [at(0, 0, 2), at(9, 9, 9)], 1.5)
    assert len(near) == 2 and near[0].triangles.tolist() == [[0, 1]] and len(near[1]) == 0
    np.testing.assert_allclose(near[0].distance, [1.0])


def test_the_way_out_frees_the_cube(cube):
    way = glissade.way_out(cube, cube, at(0.09, 0.01, 0), clearance=1e-3)
    assert 0.011 <= np.linalg.norm(way) < 0.0115
    assert not glissade.intersects(cube, cube, at(0.09 + way[0], 0.01 + way[1], way[2]), tolerance=1e-3)


def test_a_mesh_has_no_inside(cube):
    ball = glissade.Tree(glissade.Mesh.shape("sphere", radius_m=0.01))
    inside = at(0.02, 0, 0)  # 20 mm from the face at x = 50 mm
    assert not glissade.intersects(cube, ball, inside)
    assert glissade.distance(cube, ball, inside).distance == pytest.approx(0.02, abs=1e-4)
    assert glissade.way_out(cube, ball, inside).tolist() == [0, 0, 0]


def test_meshes_that_intersect_have_no_closest_points(cube):
    points = glissade.distance(cube, cube, [at(0.05, 0, 0), at(0.15, 0, 0)])
    assert points.distance[0] == 0 and np.isnan(points.p_A[0]).all() and np.isnan(points.p_B[0]).all()
    assert points.triangles[0].tolist() == [-1, -1] and np.isfinite(points.p_A[1]).all()


def test_rows_and_matrices_of_poses_give_the_same_answers(cube):
    rows = [at(0.15, 0, 0), [0.1, 0.1, 0, np.sqrt(0.5), 0, 0, np.sqrt(0.5)]]  # the second turned by 90 degrees about z
    matrices = np.tile(np.eye(4), (2, 1, 1))
    matrices[0, 0, 3] = 0.15
    matrices[1, :2, :2] = [[0, -1], [1, 0]]
    matrices[1, :2, 3] = 0.1
    np.testing.assert_allclose(
        glissade.distance(cube, cube, rows).distance, glissade.distance(cube, cube, matrices).distance, atol=1e-15
    )


def test_answers_have_the_shape_of_the_poses(cube):
    poses = np.tile(at(0.2, 0, 0), (3, 5, 1))
    assert glissade.intersects(cube, cube, poses).shape == (3, 5)
    assert glissade.distance(cube, cube, poses).p_A.shape == (3, 5, 3)
    assert glissade.intersects(cube, cube, np.zeros((0, 7))).shape == (0,)


@pytest.mark.parametrize("options", [{"threads": 3}, {"coherent": True}, {"coherent": True, "threads": 2}])
def test_threads_and_coherence_change_no_bit(torus, ball, options):
    poses = random_poses(500, 0.15, seed=1)
    plain = glissade.distance(torus, ball, poses)
    other = glissade.distance(torus, ball, poses, **options)
    assert plain.distance.tobytes() == other.distance.tobytes()
    assert plain.p_A.tobytes() == other.p_A.tobytes()
    assert 0.1 < glissade.intersects(torus, ball, poses).mean() < 0.9
    assert (glissade.intersects(torus, ball, poses) == glissade.intersects(torus, ball, poses, **options)).all()


def test_a_pipeline_whose_objects_come_and_go_agrees_with_queries():
    pipeline = glissade.Pipeline(threads=1)
    for i in range(100):
        trees = [glissade.Tree(glissade.Mesh.shape("box", size_x_m=0.01 * (1 + (i + k) % 5))) for k in range(2)]
        a, b, c = (pipeline.add(tree, at(x, 0, 0)) for tree, x in [(trees[0], 0), (trees[1], 0.03), (trees[0], 1)])
        meets = glissade.intersects(trees[0], trees[1], at(0.03, 0, 0))
        assert [sorted(pair) for pair in pipeline.step().tolist()] == ([sorted([a, b])] if meets else [])
        for one in [a, b, c]:
            pipeline.remove(one)


def test_a_pipeline_finds_the_pairs_that_meet(cube):
    pipeline = glissade.Pipeline(threads=1)
    a, b, c = (pipeline.add(cube, at(0.2 * i, 0, 0)) for i in range(3))
    assert pipeline.step().tolist() == []
    pipeline.move([b, c], [at(0.05, 0, 0), at(0.12, 0, 0)])
    assert pipeline.step().tolist() == [[a, b], [b, c]]
    pipeline.disable_pair(a, b)
    pipeline.remove(c)
    assert pipeline.step().tolist() == []
