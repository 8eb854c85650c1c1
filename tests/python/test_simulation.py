"""Scenes and simulations: sliding, hands, and their tables."""

import numpy as np
import pytest
from conftest import at, box_on_plate

import glissade


def test_the_hand_feels_the_spring_of_the_depth_that_it_is_too_deep():
    simulation = glissade.Simulation(box_on_plate())
    assert (simulation.wrench()[0] == 0).all() and simulation.contacts() == []
    for _ in range(1000):
        simulation.advance(at(0.1, 0, 0.017))
    margin = 6.2e-6  # a ten-thousandth of the radius, which the box keeps from the plate
    np.testing.assert_allclose(simulation.X_WV()[:3, 3], [0.1, 0, 0.02], atol=margin)
    np.testing.assert_allclose(simulation.wrench()[0], [0, 0, 3.0], atol=1000 * margin)
    np.testing.assert_allclose(simulation.lag()[0], [0, 0, -0.003], atol=margin)
    contacts = simulation.contacts()
    assert len(contacts) == 4 and {contact.body for contact in contacts} == {"plate"}
    assert sum(contact.force for contact in contacts) == pytest.approx(3.0, abs=1000 * margin)
    np.testing.assert_allclose(contacts[0].n_W, [0, 0, 1], atol=1e-12)
    assert simulation.state() == "resting" and 0 < simulation.clearance() < margin


def test_a_path_in_one_call_is_the_path_step_by_step():
    path = np.array([at(1e-4 * i, 0, 0.03 - 2e-5 * i) for i in range(800)])
    stepped = glissade.Simulation(box_on_plate())
    track = glissade.Simulation(box_on_plate()).follow(path, clearance=True)
    assert len(track) == 800
    for i, X_WG in enumerate(path):
        stepped.advance(X_WG)
        assert track.X_WV[i].tobytes() == stepped.X_WV().tobytes()
        assert track.f_W[i].tobytes() == stepped.wrench()[0].tobytes()
        assert track.state[i] == stepped.state()
    assert track.clearance[100] == pytest.approx(0.01 - 2e-3, abs=1e-4)
    assert (track.clearance > 0).all() and track.pushing[-1] > 0 and track.pushing[0] == 0


@pytest.mark.parametrize("milliseconds", [1.0, 10.0])
def test_a_part_follows_a_jump_by_30_mm_at_once_and_then_by_a_fifth_of_a_metre_a_second(milliseconds):
    simulation = glissade.Simulation(box_on_plate())  # at the height of 30 mm
    near = simulation.follow([at(0, 0, 0.05)], milliseconds)
    assert near.X_WV[0, 2, 3] == pytest.approx(0.05, abs=1e-9)
    far = simulation.follow(np.tile(at(0, 0, 0.25), (20, 1)), milliseconds)
    assert 0.079 < far.X_WV[0, 2, 3] <= 0.08 and (far.f_W == 0).all() and far.state[0] == "catching-up"
    np.testing.assert_allclose(np.diff(far.X_WV[:, 2, 3]), 2e-4 * milliseconds, atol=1e-6)


def test_a_path_without_poses_is_a_table_without_rows():
    track = glissade.Simulation(box_on_plate()).follow(np.zeros((0, 7)), clearance=True)
    assert len(track) == 0 and track.X_WV.shape == (0, 4, 4) and track.clearance.shape == (0,)


def test_friction_holds_back_what_slides():
    def height_and_lag(friction):
        scene = box_on_plate()
        scene.rules.friction = friction
        simulation = glissade.Simulation(scene)
        simulation.follow(np.tile(at(0, 0, 0.017), (200, 1)))
        simulation.follow([at(1e-6 * i, 0, 0.017) for i in range(500)])
        return simulation.wrench()[0][0]

    assert height_and_lag((0.0, 0.0)) == pytest.approx(0.0, abs=1e-9)
    assert height_and_lag((0.3, 0.3)) == pytest.approx(-0.5, abs=0.02)  # 0.5 mm behind, 1000 N/m, less than 0.3 x 3 N


def test_a_hand_lifts_a_ball():
    scene = glissade.Scene()
    table = glissade.Mesh.shape("box", size_x_m=0.6, size_y_m=0.6, size_z_m=0.02, triangles=200)
    scene.add("table", table, at(0.1, 0, -0.102))
    scene.add("ball", glissade.Mesh.shape("sphere", radius_m=0.035, triangles=2000), at(0.095, 0, -0.056), movable=True)
    scene.hands = [glissade.HandShape()]
    ms = np.arange(1100)
    closing = [name for name in glissade.JOINT_NAMES if name.startswith(("thumb_roll", "thumb_mcp"))]
    closing += [f"{finger}_{joint}" for finger in ["index", "middle", "ring", "little"] for joint in ["mcp", "pip"]]
    angles = np.zeros((len(ms), 22))
    for name in closing:
        angles[:, glissade.JOINT_NAMES.index(name)] = 1.2 * np.minimum(1, ms / 300)
    X_WR = np.array([at(0, 0, z) for z in 0.2 * np.clip((ms - 500) / 500, 0, 1)])
    simulation = glissade.Simulation(scene)
    track = simulation.follow_hands(X_WR, angles)
    assert track.X_WV[-1, 2, 3] - track.X_WV[0, 2, 3] == pytest.approx(0.2, abs=1e-3)
    assert simulation.held_part() == 0
    assert simulation.grasp().startswith(("power", "precision"))
    np.testing.assert_allclose(simulation.posture().X_WR[2, 3], 0.2, atol=1e-9)
    simulation.advance_hands([None])  # the tracking is lost: the hand keeps what it holds
    assert simulation.held_part() == 0


def test_a_scene_is_written_and_read_without_loss(tmp_path):
    scene = box_on_plate(compliance_point_B=[0, 0, -0.02])
    scene.add("gate", glissade.Mesh.shape("box"), motion=([0, 0.5], [at(1, 0, 0), at(1, 0.1, 0)]))
    scene.write(tmp_path / "scene.yaml")
    again = glissade.Scene.read(tmp_path / "scene.yaml")
    assert again.names == ["plate", "box", "gate"] and again.movable_names == ["box"]
    path = np.array([at(1e-4 * i, 0, 0.03 - 2e-5 * i) for i in range(700)])
    first, second = (glissade.Simulation(each).follow(path) for each in (scene, again))
    assert first.X_WV.tobytes() == second.X_WV.tobytes() and first.t_W.tobytes() == second.t_W.tobytes()
    with pytest.raises(ValueError, match="gate.yaml|scene.yaml"):
        scene.add("more", glissade.Mesh.shape("box"), at(3, 0, 0))
        scene.write(tmp_path / "scene.yaml")


def test_settings_keep_their_values():
    scene = glissade.Scene()
    scene.metaphor = "rubber-band"
    scene.up_W = [0, 1, 0]
    scene.rules = glissade.SlidingRules.real_time()
    scene.rules.overlap = "depenetrate"
    scene.rules.margin_m = 1e-5
    assert scene.metaphor == "rubber-band" and scene.up_W.tolist() == [0, 1, 0]
    assert scene.rules.has_search_thread and scene.rules.overlap == "depenetrate" and scene.rules.margin_m == 1e-5
    for wrong in [lambda: setattr(scene, "metaphor", "glue"), lambda: setattr(scene.rules, "overlap", "ignore")]:
        with pytest.raises(ValueError, match="must be"):
            wrong()
