"""The haptic loop: what a hand in a glove feels, and what a reader sees."""

import threading
import time
import warnings

import numpy as np
import pytest
from conftest import arm, at, pressing_glove, real_time_scene

import glissade

# A machine of the tests need not grant real-time priority.
pytestmark = pytest.mark.filterwarnings("ignore:SCHED_FIFO")


def wait_for(server, condition, seconds=20.0):
    """The first frame that meets the condition."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        frame = server.frame()
        if condition(frame):
            return frame
        server.run_for(0.005)
    raise AssertionError("it never came")


def drive(glove, height, turns):
    """A driver: puts the height of each turn, and returns the commands."""
    commands = []
    for turn in range(turns):
        glove.put(at(0, 0, height(turn)))
        commands.append(glove.command())
        time.sleep(0.005)
    return commands


def test_a_simulated_hand_feels_the_plate_and_the_box_stays_on_it():
    with glissade.HapticServer(real_time_scene(), pressing_glove()) as server:
        frame = wait_for(server, lambda frame: frame.f_W[0, 2] > 1.0)
        assert server.is_running and frame.tick > 0
        assert frame.held_parts == (0,) and frame.pushing[0] > 0
        assert frame.X_WV[0, 2, 3] > 0.02 > frame.X_WG[0, 2, 3]
        assert frame.states[0] in ("sliding", "resting")
        assert set(frame.contact_parts) == {0}
        np.testing.assert_allclose(frame.contact_n_W, np.tile([0, 0, 1], (len(frame.contact_parts), 1)), atol=1e-6)
        assert (np.abs(frame.contact_p_W[:, 2]) < 1e-4).all()  # on the plate
        assert abs(frame.time_s - time.monotonic()) < 5.0
    assert not server.is_running
    assert (server.frame().f_W == 0).all() and server.frame().reasons[0][0] == "stopped"


def test_a_frame_before_the_start_shows_the_scene():
    server = glissade.HapticServer(real_time_scene(), pressing_glove())
    frame = server.frame()
    assert frame.tick == 0 and not server.is_running
    np.testing.assert_array_equal(frame.X_WV[0][:3, 3], [0, 0, 0.03])
    assert frame.f_W.tolist() == [[0, 0, 0]] and frame.held_parts == (None,) and len(frame.contact_parts) == 0


def test_statistics_have_units_and_count_the_ticks():
    with glissade.HapticServer(real_time_scene(), pressing_glove()) as server:
        wait_for(server, lambda frame: frame.tick > 100)
        assert "tick_p99_us" not in server.statistics()  # the haptic thread still writes it
    figures = server.statistics()
    assert figures["ticks"] > 100 and figures["late_ticks"] >= 0
    assert 0 < figures["tick_p50_us"] <= figures["tick_p99_us"] and figures["lost_records"] == 0
    assert isinstance(figures["has_real_time_priority"], bool)


def test_missing_rights_are_a_warning():
    server = glissade.HapticServer(real_time_scene(), pressing_glove())
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        server.start()
    is_warned = any("SCHED_FIFO is not granted" in str(warning.message) for warning in caught)
    assert is_warned != server.statistics()["has_real_time_priority"]
    server.stop()


def test_a_driver_in_python_gets_a_force_that_fades_when_the_server_ends():
    glove = arm()
    assert glove.command().f_H_W.tolist() == [0, 0, 0]  # before the first state
    server = glissade.HapticServer(real_time_scene(), glove)
    server.start()
    pressed = drive(glove, lambda turn: 0.1 - 0.02 * min(1.0, turn / 100), 300)
    forces = np.array([command.f_H_W for command in pressed])
    assert 1.0 < forces[:, 2].max() <= 10.0
    assert np.abs(np.diff(forces[:, 2])).max() < 10.0 * 2 / 7 + 0.1  # full force takes seven periods
    assert 0 <= pressed[-1].age_s < 1.0 and pressed[-1].joint_torques.shape == (22,)
    threading.Timer(0.1, server.stop).start()
    after = drive(glove, lambda turn: 0.08, 200)
    assert (after[-1].f_H_W == 0).all() and after[-1].t_H_W.tolist() == [0, 0, 0]
    assert {"stopped", "command-old"} & set(after[-1].reasons) and "no force" in after[-1].reason
    server.stop()


def test_the_force_fades_when_states_stop():
    glove = arm()
    with glissade.HapticServer(real_time_scene(), glove):
        pressed = drive(glove, lambda turn: 0.1 - 0.02 * min(1.0, turn / 100), 200)
        assert max(command.f_H_W[2] for command in pressed) > 0.5
        for _ in range(40):  # commands are taken, but no states are put
            last = glove.command()
            time.sleep(0.005)
    assert (last.f_H_W == 0).all() and "state-old" in last.reasons


def test_an_emergency_stop_of_server_or_glove_lasts():
    for stop in ["server", "glove"]:
        glove = arm()
        with glissade.HapticServer(real_time_scene(), glove) as server:
            drive(glove, lambda turn: 0.1 - 0.02 * min(1.0, turn / 100), 200)
            server.emergency_stop() if stop == "server" else glove.stop()
            for command in drive(glove, lambda turn: 0.08, 100)[-20:]:
                assert (command.f_H_W == 0).all()


def test_a_wearer_who_lets_go_of_the_switch_feels_nothing():
    glove = arm()
    with glissade.HapticServer(real_time_scene(), glove):
        drive(glove, lambda turn: 0.1 - 0.02 * min(1.0, turn / 100), 200)
        for _ in range(40):
            glove.put(at(0, 0, 0.08), is_enabled=False)
            last = glove.command()
            time.sleep(0.005)
    assert (last.f_H_W == 0).all() and "disabled" in last.reasons


def test_hands_take_and_leave_parts():
    with glissade.HapticServer(real_time_scene(), pressing_glove()) as server:
        wait_for(server, lambda frame: frame.held_parts == (0,))
        server.release(0)
        # The simulation answers the release a tick later.
        wait_for(server, lambda frame: frame.held_parts == (None,) and frame.states == ("released",))
        server.grasp(0, 0)
        wait_for(server, lambda frame: frame.held_parts == (0,))
        with pytest.raises(ValueError, match="hand 0 cannot take part 7"):
            server.grasp(0, 7)
        with pytest.raises(ValueError, match="there is no hand 3"):
            server.release(3)
    with pytest.raises(RuntimeError, match="does not run"):
        server.grasp(0, 0)


def test_two_hands_hold_a_part_each():
    scene = real_time_scene()
    scene.add("ball", glissade.Mesh.shape("sphere", radius_m=0.02), at(0.12, 0, 0.05), movable=True)
    with glissade.HapticServer(scene, pressing_glove(), pressing_glove()) as server:
        wait_for(server, lambda frame: frame.held_parts == (0, 0))
        server.grasp(1, 1)
        frame = wait_for(server, lambda frame: frame.held_parts == (0, 1))
        assert frame.X_WV.shape == (2, 4, 4) and frame.f_W.shape == (2, 3) and len(frame.energy_J) == 2


def test_fingers_that_close_on_a_ball_are_stopped_and_feel_it():
    scene = glissade.Scene()
    scene.rules = glissade.SlidingRules.real_time()
    table = glissade.Mesh.shape("box", size_x_m=0.6, size_y_m=0.6, size_z_m=0.02, triangles=200)
    scene.add("table", table, at(0.1, 0, -0.102))
    scene.add("ball", glissade.Mesh.shape("sphere", radius_m=0.035, triangles=2000), at(0.095, 0, -0.056), movable=True)
    scene.hands = [glissade.HandShape()]
    joints = [glissade.JOINT_NAMES.index(name) for name in ["index_mcp", "middle_mcp"]]
    closed = np.zeros(22)
    closed[joints] = 1.2
    glove = glissade.SimulatedGlove([0, 0.3], [at(0, 0, 0)] * 2, angles=[np.zeros(22), closed])
    with glissade.HapticServer(scene, glove) as server:
        frame = wait_for(server, lambda frame: (frame.joint_torques[0, joints] < -0.05).any())
        assert 0.1 < frame.angles[0, joints].max() < 1.2
        np.testing.assert_allclose(frame.X_WH[0, :3, 3], 0, atol=0.05)


@pytest.mark.parametrize("preset", glissade.GLOVE_PRESETS)
def test_every_preset_is_a_glove(preset):
    assert glissade.SimulatedGlove([0, 1], [at(0, 0, 0)] * 2, model=preset).script_time_s == 0.0


def test_a_glove_serves_one_server_at_a_time():
    glove = pressing_glove()
    with glissade.HapticServer(real_time_scene(), glove):
        other = glissade.HapticServer(real_time_scene(), glove)
        with pytest.raises(ValueError, match="glove 0 is in use by a server"):
            other.start()
        with pytest.raises(ValueError, match="glove 1 is in use"):
            second = pressing_glove()
            glissade.HapticServer(real_time_scene(), second, second).start()
    with other:  # the glove is free again, and the failed start took nothing
        wait_for(other, lambda frame: frame.tick > 10)


def test_a_server_starts_once_and_stops_as_often_as_one_likes():
    server = glissade.HapticServer(real_time_scene(), pressing_glove())
    with pytest.raises(RuntimeError, match="has not started"):
        server.statistics()
    with pytest.raises(RuntimeError, match="has not started"):
        server.run_for(0)
    server.stop()
    server.start()
    with pytest.raises(RuntimeError, match="starts once"):
        server.start()
    server.stop()
    server.stop()
    with pytest.raises(RuntimeError, match="starts once"):
        server.start()


def test_threads_read_frames_while_another_stops_the_server():
    server = glissade.HapticServer(real_time_scene(), pressing_glove())
    server.start()
    ends = threading.Event()
    ticks = [[] for _ in range(4)]

    def read(mine):
        while not ends.is_set():
            mine.append(server.frame().tick)
            server.statistics()

    readers = [threading.Thread(target=read, args=[mine]) for mine in ticks]
    for reader in readers:
        reader.start()
    time.sleep(0.3)
    stoppers = [threading.Thread(target=server.stop) for _ in range(3)]
    for stopper in stoppers:
        stopper.start()
    for stopper in stoppers:
        stopper.join()
    ends.set()
    for reader in readers:
        reader.join()
    for mine in ticks:
        assert len(mine) > 10 and mine == sorted(mine)


@pytest.mark.parametrize(
    "call, error, sentence",
    [
        (lambda: glissade.HapticServer(real_time_scene()), ValueError, "takes 1 to 4 gloves, not 0"),
        (lambda: glissade.HapticServer(real_time_scene(), *[arm()] * 5), ValueError, "takes 1 to 4 gloves, not 5"),
        (lambda: glissade.HapticServer(real_time_scene(), arm(), 3), TypeError, "argument 2 after the scene is no Glove"),
        (lambda: glissade.HapticServer(real_time_scene(), None), TypeError, "argument 1 after the scene is no Glove"),
        (lambda: glissade.HapticServer(glissade.Scene(), arm()), ValueError, "no object is movable"),
        (lambda: glissade.HapticServer(real_time_scene(), arm(), record=5), TypeError, "os.PathLike"),
        (lambda: glissade.SimulatedGlove([0, 1], [at(0, 0, 0)]), ValueError, "times_s and X_WH must be n times"),
        (lambda: glissade.SimulatedGlove([1, 0], [at(0, 0, 0)] * 2), ValueError, "time"),
        (lambda: glissade.SimulatedGlove([], np.zeros((0, 7))), ValueError, "row"),
        (lambda: glissade.SimulatedGlove([0, 2e9], [at(0, 0, 0)] * 2), ValueError, "times_s[1] is beyond 1e9 s"),
        (lambda: glissade.SimulatedGlove("now", [at(0, 0, 0)]), TypeError, "times_s is an array of <U3"),
        (lambda: glissade.SimulatedGlove([0], [at(0, 0, 0)], angles=np.zeros(22)), ValueError, "angles must have the shape"),
        (lambda: glissade.SimulatedGlove([0], [at(0, 0, 0)], angles=[[np.nan] * 22]), ValueError, "angles has a number that"),
        (lambda: glissade.SimulatedGlove([0], [at(0, 0, 0)], model="omega_8"), ValueError, "omega_8"),
        (lambda: arm(max_force_kN=1), TypeError, "has no 'max_force_kN'; it has max_force_N"),
        (lambda: arm(max_force_N="strong"), TypeError, "max_force_N is no number"),
        (lambda: arm(max_force_N=-1), ValueError, "max_force"),
        (lambda: arm(delay_s=5), ValueError, "delay"),
        (lambda: arm(update_rate_Hz=0), ValueError, "update"),
        (lambda: arm(joint_lower_rad=np.zeros(3)), ValueError, "joint_lower_rad must have the shape (22,)"),
        (lambda: arm().put([0, 0, 0]), ValueError, "X_WH has the shape (3,)"),
        (lambda: arm().put(at(0, 0, np.nan)), ValueError, "X_WH has a number that is not finite"),
        (lambda: arm().put(at(0, 0, 0), v_WH=[0, 0]), ValueError, "v_WH has the shape (2,)"),
        (lambda: arm().put(at(0, 0, 0), w_WH=[0, 0, np.inf]), ValueError, "w_WH has a number that is not finite"),
        (lambda: arm().put(at(0, 0, 0), angles=[0]), ValueError, "angles must have the shape (22,)"),
        (lambda: arm().put(at(0, 0, 0), time_s=np.nan), ValueError, "time_s is beyond 1e9 s"),
        (lambda: glissade.LcmGlove("http://here"), ValueError, "http://here"),
        (lambda: glissade.LcmGlove("memq://", timeout_s=np.nan), ValueError, "timeout_s must be from 0 to 1e6"),
        (lambda: glissade.LcmGlove("memq://", device=4, timeout_s=0), RuntimeError, "glove 4 is silent at memq://"),
        (lambda: glissade.HapticServer(real_time_scene(), arm()).run_for(-1), ValueError, "seconds must be from 0"),
    ],
)
def test_wrong_arguments_are_named(call, error, sentence):
    with pytest.raises(error) as caught:
        call()
    assert sentence in str(caught.value)


def test_random_states_of_a_driver_raise_or_are_refused():
    random = np.random.default_rng(9)
    values = [np.nan, np.inf, -np.inf, 1e300, -1e9, 0.0, 1.0, 5e-324]
    glove = arm()
    with glissade.HapticServer(real_time_scene(), glove) as server:
        for _ in range(1000):
            pose = at(*random.choice(values, 3)) if random.integers(2) else random.choice(values, 7)
            try:
                glove.put(pose, v_WH=random.choice(values, 3), time_s=random.choice(values),
                          angles=random.choice(values, 22), grip=int(random.integers(-(2**62), 2**62)))
            except ValueError:
                pass
            assert np.abs(glove.command().f_H_W).max() <= 10.0
        assert np.isfinite(server.frame().f_W).all()
