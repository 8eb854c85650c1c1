"""The page that shows a scene, a simulation, a server or a recording."""

import contextlib
import os
import socket
import struct
import subprocess
import sys
import threading
import time
import types
import urllib.error
import urllib.request

import numpy as np
import pytest
from conftest import at, box_on_plate

import glissade

pytestmark = pytest.mark.filterwarnings("ignore:SCHED_FIFO")


@pytest.fixture(autouse=True)
def opened(monkeypatch):
    """The addresses that a browser would have opened."""
    urls = []
    monkeypatch.setattr("webbrowser.open", urls.append)
    return urls


def served(url):
    with urllib.request.urlopen(url, timeout=10) as answer:
        return answer.read(), answer.headers


@contextlib.contextmanager
def frames_of(view):
    """A page without its scripts: a function that waits for the next frame, and gives its bytes."""
    host = view.url.split("/")[2]
    with socket.create_connection(host.split(":"), timeout=10) as connection:
        connection.sendall(f"GET /live HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                           f"Sec-WebSocket-Key: {'A' * 22}==\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        stream = connection.makefile("rb")
        assert b"101" in stream.readline()
        while stream.readline() != b"\r\n":
            pass

        def next_frame():
            size = stream.read(2)[1]
            size = struct.unpack(">H", stream.read(2))[0] if size == 126 else size
            frame = stream.read(size)
            connection.sendall(b"\x82\x80" + bytes(4))  # an empty message: the page has shown it
            return frame

        yield next_frame


def visible_z(frame):
    """The height of the first part's visible pose, from the middle of the scene."""
    values = np.frombuffer(frame[16:], dtype="<f4")  # after time and tick
    return values[10 + 7 + 2]


def test_a_scene_is_a_page_with_a_model(opened):
    with glissade.view(box_on_plate()) as view:
        page, headers = served(view.url)
        assert opened == [view.url] and b"<html" in page
        assert "frame-ancestors http://localhost:*" in headers["Content-Security-Policy"]
        assert served(view.url + "model.glb")[0][:4] == b"glTF"
        assert view.is_open and repr(view) == f"<glissade.View at {view.url}>"
    assert not view.is_open
    with pytest.raises(urllib.error.URLError):
        served(view.url)
    view.close()


def test_a_simulation_is_shown_while_it_moves():
    simulation = glissade.Simulation(box_on_plate())
    with glissade.view(simulation) as view, frames_of(view) as next_frame:
        start = visible_z(next_frame())
        simulation.follow([at(0, 0, 0.03 - 1e-5 * i) for i in range(700)])
        while visible_z(next_frame()) > start - 0.0069:  # the last frame is that of the last pose
            pass


def test_a_server_is_shown_from_before_its_start(opened):
    scene = box_on_plate()
    scene.rules = glissade.SlidingRules.real_time()
    server = glissade.HapticServer(scene, glissade.SimulatedGlove([0, 0.3], [at(0, 0, 0.1), at(0, 0, 0.08)]))
    with glissade.view(server, browser=False) as view, frames_of(view) as next_frame:
        start = visible_z(next_frame())
        with server:
            while visible_z(next_frame()) > start - 0.005:
                pass
    assert opened == []


def test_a_recording_plays_once_with_its_scene(tmp_path):
    scene = box_on_plate()
    scene.rules = glissade.SlidingRules.real_time()
    glove = glissade.SimulatedGlove([0, 0.2], [at(0, 0, 0.1), at(0, 0, 0.08)])
    with glissade.HapticServer(scene, glove, record=tmp_path / "log") as server:
        while server.frame().X_WV[0, 2, 3] > 0.0205:
            server.run_for(0.01)
    recording = glissade.read_recording(tmp_path / "log")
    with glissade.view(recording, scene) as view, frames_of(view) as next_frame:
        start = visible_z(next_frame())
        while visible_z(next_frame()) > start - 0.009:
            pass
    with pytest.raises(TypeError, match=r"needs its scene: view\(recording, scene\)"):
        glissade.view(recording)
    scene.add("second", glissade.Mesh.shape("sphere", radius_m=0.01), at(1, 0, 0), movable=True)
    with pytest.raises(ValueError, match="another scene: it has 1 parts, and this scene 2"):
        glissade.view(recording, scene)


def test_a_notebook_shows_a_frame_instead_of_a_browser(opened, monkeypatch):
    shell = type("ZMQInteractiveShell", (), {})()
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
    with glissade.view(box_on_plate()) as view:
        assert opened == [] and f'<iframe src="{view.url}"' in view._repr_html_()
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: None))
    with glissade.view(box_on_plate()) as view:
        assert opened == [view.url]
    monkeypatch.setitem(sys.modules, "IPython", None)  # kept out
    glissade.view(box_on_plate()).close()
    assert len(opened) == 2


def test_wait_returns_after_ctrl_c():
    threading.Timer(0.3, os.kill, [os.getpid(), 2]).start()
    start = time.monotonic()
    view = glissade.view(box_on_plate(), wait=True)
    assert not view.is_open and 0.2 < time.monotonic() - start < 20


def test_importing_the_module_needs_no_browser_and_no_notebook():
    program = "import sys, glissade; assert not {'IPython', 'webbrowser', 'socket'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.parametrize(
    "call, error, sentence",
    [
        (lambda: glissade.view(3), TypeError, "a view shows a Scene, Simulation, HapticServer or Recording"),
        (lambda: glissade.view(None), TypeError, "a view shows"),
        (lambda: glissade.view(glissade.Scene()), ValueError, "the scene has no objects"),
        (lambda: glissade.view(box_on_plate(), box_on_plate()), TypeError, "only a recording needs a scene"),
        (lambda: glissade.view(box_on_plate(), port=70000), TypeError, "port"),
        (lambda: glissade.view(box_on_plate(), port="any"), TypeError, "port"),
    ],
)
def test_wrong_arguments_are_named(call, error, sentence):
    with pytest.raises(error) as caught:
        call()
    assert sentence in str(caught.value)


def test_a_port_in_use_is_named():
    with glissade.view(box_on_plate()) as view:
        port = int(view.url.split(":")[2].strip("/"))
        with pytest.raises(ValueError, match=str(port)):
            glissade.view(box_on_plate(), port=port)
