"""Event logs as tables of NumPy."""

import os
import pathlib
import re
import threading

import numpy as np
import pytest
from conftest import arm, at, box_on_plate, pressing_glove, real_time_scene

import glissade

pytestmark = pytest.mark.filterwarnings("ignore:SCHED_FIFO")


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A log of half a second in which a hand presses the box on the plate."""
    path = tmp_path_factory.mktemp("logs") / "press.lcmlog"
    scene = box_on_plate()
    scene.rules = glissade.SlidingRules.real_time()
    glove = glissade.SimulatedGlove([0, 0.2], [at(0, 0, 0.1), at(0, 0, 0.07)])
    server = glissade.HapticServer(scene, glove, record=path)
    with server:
        while server.statistics()["ticks"] < 600:
            server.run_for(0.02)
    assert server.statistics()["lost_records"] == 0
    return path


def test_every_tick_has_its_rows(log):
    recording = glissade.read_recording(log)
    ticks = recording.ticks
    assert recording.path == str(log) and len(ticks) >= 600
    assert (np.diff(ticks["tick"]) == 1).all() and (np.diff(ticks["t_s"]) > 0).all()
    assert (ticks["duration_us"] > 0).all() and ticks["is_stopped"].dtype == bool
    assert recording.parts["X_WV"].shape == (len(recording.parts), 4, 4)
    assert (recording.parts["part"] == 0).all() and (recording.hands["hand"] == 0).all()
    assert 0 <= len(ticks) - len(recording.parts) < 100  # the ticks of the final fade show nothing


def test_what_the_hand_felt_is_what_the_contacts_say(log):
    recording = glissade.read_recording(log)
    parts, hands, contacts = recording.parts, recording.hands, recording.contacts
    assert parts["X_WV"][:, 2, 3].min() > 0.02 > parts["X_WG"][:, 2, 3].min()
    assert set(parts["state"]) <= {"unknown", "released", "free", "sliding", "resting", "catching-up"}
    assert {"free"} < set(parts["state"])
    assert hands["f_W_N"][:, 2].max() > 0.1 and (hands["grasp"] == "none").all()
    pushed = np.isin(hands["tick"], contacts["tick"])
    assert pushed.any() and not pushed.all()
    np.testing.assert_allclose(contacts["n_W"], np.tile([0, 0, 1], (len(contacts), 1)), atol=1e-6)
    assert np.abs(contacts["p_W_m"][:, 2]).max() < 1e-4
    bit = glissade.LIMIT_REASONS.index("returning")
    assert (hands["reasons"] >> bit & 1).any()  # the force returns softly at the start


def test_the_glove_measured_the_pose_of_the_hand(log):
    gloves = glissade.read_recording(log).gloves
    assert set(gloves["device"]) == {1} and (np.diff(gloves["sequence"]) > 0).all()
    assert gloves["X_WH"][0, 2, 3] == pytest.approx(0.1, abs=1e-3) and gloves["is_enabled"].all()
    assert gloves["angles_rad"].shape == (len(gloves), 22)
    v_m_per_s = np.diff(gloves["X_WH"][:, 2, 3]) / np.diff(gloves["t_s"])
    assert np.median(gloves["v_WH_m_per_s"][1:, 2] - v_m_per_s) == pytest.approx(0, abs=0.02)


def test_the_docs_list_the_fields(log):
    recording = glissade.read_recording(log)
    page = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md").read_text()
    for table in ["ticks", "parts", "hands", "contacts", "gloves"]:
        row = re.search(rf"^\| `{table}` \|(.*)\|$", page, re.M)[1]
        assert re.findall(r"`(\w+)`", row) == list(getattr(recording, table).dtype.names), table


def test_a_damaged_log_is_read_up_to_the_damage(log, tmp_path):
    whole = log.read_bytes()
    (tmp_path / "cut.lcmlog").write_bytes(whole[: len(whole) // 2])
    with pytest.warns(UserWarning, match="cut.lcmlog") as caught:
        recording = glissade.read_recording(tmp_path / "cut.lcmlog")
    assert caught[0].filename == __file__
    assert 100 < len(recording.ticks) < len(glissade.read_recording(log).ticks)


def test_random_damage_raises_or_warns(log, tmp_path):
    random = np.random.default_rng(11)
    start = np.frombuffer(log.read_bytes()[:60000], dtype=np.uint8)
    for _ in range(50):
        bytes_ = start.copy()
        bytes_[random.integers(len(bytes_), size=5)] = random.integers(256, size=5)
        (tmp_path / "log").write_bytes(bytes_.tobytes())
        try:
            with pytest.warns(UserWarning):  # the cut alone is damage
                glissade.read_recording(tmp_path / "log")
        except ValueError:
            pass


@pytest.mark.parametrize("content", [None, b"t_s,tick\n0,1\n", b""])
def test_no_event_log(content, tmp_path):
    if content is not None:
        (tmp_path / "table.csv").write_bytes(content)
    with pytest.raises(ValueError, match="table.csv"):
        glissade.read_recording(tmp_path / "table.csv")


def test_a_start_whose_file_cannot_be_written_names_it_and_may_be_repeated(tmp_path):
    path = tmp_path / "folder" / "log"
    server = glissade.HapticServer(real_time_scene(), pressing_glove(), record=path)
    with pytest.raises(ValueError, match=str(path)):
        server.start()
    assert not server.is_running
    path.parent.mkdir()
    with server:
        while server.statistics()["ticks"] < 50:
            server.run_for(0.01)
    assert len(glissade.read_recording(path).ticks) >= 50


def test_a_start_that_fails_leaves_an_older_recording_alone(tmp_path):
    path = tmp_path / "log"
    path.write_bytes(b"older")
    server = glissade.HapticServer(real_time_scene(), arm(max_stiffness_N_per_m=0), record=path)
    with pytest.raises(ValueError, match="stiffness"):
        server.start()
    assert path.read_bytes() == b"older"


def test_other_threads_run_while_a_start_opens_its_recording(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)
    server = glissade.HapticServer(real_time_scene(), pressing_glove(), record=path)
    starter = threading.Thread(target=server.start)
    starter.start()
    with open(path, "rb") as pipe:  # until now, the start has waited for a reader
        read = []
        reader = threading.Thread(target=lambda: read.append(pipe.read()))
        reader.start()
        starter.join()
        while server.frame().tick == 0:
            server.run_for(0.01)
        server.stop()
        reader.join()
    assert b"GLOVE_INFO" in read[0]


def test_a_path_with_a_null_byte_is_no_path():
    with pytest.raises(ValueError, match="null byte"):
        glissade.read_recording("log\0")


def test_a_track_is_the_recording_of_a_simulation(tmp_path):
    track = glissade.Simulation(box_on_plate()).follow(np.tile(at(0, 0, 0.017), (50, 1)))
    np.savez(tmp_path / "track.npz", X_WV=track.X_WV, f_W_N=track.f_W)
    with np.load(tmp_path / "track.npz") as again:
        assert again["X_WV"].tobytes() == track.X_WV.tobytes()
