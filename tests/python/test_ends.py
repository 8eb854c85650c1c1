"""Programs end without abort or hang, whatever runs, and whatever becomes of its objects."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

START = """
import gc, os, signal, sys, threading, time, warnings
warnings.simplefilter("ignore")
from conftest import *
scene = box_on_plate()
scene.rules = glissade.SlidingRules.real_time()
glove = glissade.SimulatedGlove([0, 0.3], [at(0, 0, 0.1), at(0, 0, 0.08)])
arm = glissade.RelayGlove("arm", max_force_N=10, max_torque_Nm=1, max_stiffness_N_per_m=500,
                          max_rotational_stiffness_Nm_per_rad=5)
server = glissade.HapticServer(scene, glove, arm)
server.start()
server.run_for(0.1)
"""

ENDINGS = {
    "the end": "",
    "an exception": "raise KeyError('the program is wrong')",
    "an exception in with": "with glissade.HapticServer(scene, glissade.SimulatedGlove([0], [at(0, 0, 0)])): 1 / 0",
    "sys.exit": "sys.exit(0)",
    "Ctrl-C": "signal.raise_signal(signal.SIGINT)",
    "Ctrl-C while it waits": "threading.Timer(0.1, os.kill, [os.getpid(), signal.SIGINT]).start(); server.run_for(60)",
    "gloves first": "del glove, arm; gc.collect(); server.run_for(0.05); del server; gc.collect()",
    "the server first": "del server; gc.collect(); time.sleep(0.05); del glove, arm; gc.collect()",
    "a cycle": "server_list = [server]; server_list.append(server_list); del server, server_list",
    "a reference that nobody drops": "import ctypes; ctypes.pythonapi.Py_IncRef(ctypes.py_object(server))",
    "a view of it": "view = glissade.view(server, browser=False); server.run_for(0.1)",
    "a view of it alone": "view = glissade.view(server, browser=False); del server, glove; time.sleep(0.1)",
    "a stopped server": "server.stop(); server.stop()",
    "a daemon thread that drives": """
def drive():
    while True:
        arm.put(at(0, 0, 0.1)); arm.command(); server.frame(); glove.script_time_s
threading.Thread(target=drive, daemon=True).start(); time.sleep(0.2)""",
    "daemon threads that stop": """
for _ in range(4): threading.Thread(target=server.stop, daemon=True).start()""",
    "a start at the end": """
import atexit
late = glissade.HapticServer(scene, glissade.SimulatedGlove([0], [at(0, 0, 0)]))
@atexit.register
def start_late():
    late.start()""",
    "a forked child": """
child = os.fork()
if child == 0:
    del server, glove
    gc.collect()
    sys.exit(0)
assert os.waitpid(child, 0)[1] == 0
assert server.frame().tick > 0""",
}
WELL = [name for name in ENDINGS if not name.startswith(("an exception", "Ctrl-C"))]


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_program_ends(ending):
    start = time.monotonic()
    ended = subprocess.run([sys.executable, "-c", START + ENDINGS[ending]], cwd=pathlib.Path(__file__).parent,
                           capture_output=True, text=True, timeout=60)
    expected = 0 if ending in WELL else -signal.SIGINT if ending.startswith("Ctrl-C") else 1
    assert ended.returncode == expected, ended.stderr
    assert "Fatal" not in ended.stderr and time.monotonic() - start < 30


def test_a_start_whose_warning_is_an_error_leaves_no_loop():
    """Without the right to real-time priority, which root gives up by setpriv."""
    program = """
import resource, warnings
from conftest import *
resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
warnings.simplefilter("error")
server = glissade.HapticServer(box_on_plate(), glissade.SimulatedGlove([0], [at(0, 0, 0)]))
try:
    server.start()
except RuntimeWarning as warning:
    assert "SCHED_FIFO is not granted" in str(warning)
    print("runs" if server.is_running else "has ended")
"""
    without_rights = ["setpriv", "--bounding-set", "-sys_nice", "--inh-caps", "-sys_nice"] if os.geteuid() == 0 else []
    ended = subprocess.run([*without_rights, sys.executable, "-c", program], cwd=pathlib.Path(__file__).parent,
                           capture_output=True, text=True, timeout=60)
    assert ended.stdout == "has ended\n", ended.stderr
