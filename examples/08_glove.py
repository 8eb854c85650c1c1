#!/usr/bin/env python3
"""A glove in Python: a hand that lowers the peg of square_peg.yaml on its plate for three seconds, and tells the force.

  lcm-gen --python --ppath types lcmtypes/*.lcm
  glissade run examples/scenes/square_peg.yaml --seconds 5 & PYTHONPATH=types examples/08_glove.py
"""
import itertools, random, socket, struct, time
from glissade import glove_command_t, glove_info_t, glove_state_t

ADDRESS, DEVICE, SESSION = ("239.255.76.67", 7667), 1, random.getrandbits(62) + 1
link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
link.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
link.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)  # this machine only
link.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(ADDRESS[0]) + bytes(4))
link.bind(ADDRESS)
link.setblocking(False)

def send(channel, message, number=itertools.count()):
    link.sendto(struct.pack(">4sI", b"LC02", next(number)) + channel + b"\0" + message.encode(), ADDRESS)

def newest_command(newest):
    while True:
        try:
            channel, _, body = link.recv(65536)[8:].partition(b"\0")
        except BlockingIOError:
            return newest
        command = glove_command_t.decode(body) if channel == b"GLOVE_COMMAND" else None
        is_ours = command and (command.device, command.glove_session) == (DEVICE, SESSION)
        if is_ours and newest.session in (0, command.session):  # no second server
            newest = command

def message_of(kind, **fields):
    message = kind()
    for name, value in dict(version=kind.VERSION, device=DEVICE, session=SESSION, **fields).items():
        setattr(message, name, value)
    return message

info = message_of(  # what may not stay 0
    glove_info_t, name=b"python".ljust(32, b"\0"), update_rate_Hz=200, max_force_N=20, max_torque_Nm=1, max_power_W=50,
    max_stiffness_N_per_m=2000, max_rotational_stiffness_Nm_per_rad=5, damping_N_s_per_m=5, max_speed_m_per_s=10,
    rotational_damping_Nm_s_per_rad=0.05, max_turn_rate_rad_per_s=100, workspace_radius_m=1000)
state = message_of(glove_state_t, enabled=1, grip=1, orientation_WH_wxyz=[1, 0, 0, 0])
command, greatest_N, start = glove_command_t(), 0.0, time.monotonic()
while (now := time.monotonic() - start) < 3:
    state.sequence, state.time_ns = state.sequence + 1, time.monotonic_ns()
    state.position_WH_m = [0.0015, 0.001, 0.026 - 0.002 * min(now, 2)]
    state.v_WH_m_per_s = [0, 0, -0.002 if now < 2 else 0]
    send(b"GLOVE_STATE", state)
    if state.sequence % 40 == 1:
        send(b"GLOVE_INFO", info)
    time.sleep(5e-3)
    command = newest_command(command)
    state.leaseholder, state.command_age_ns = command.session, time.monotonic_ns() - command.state_time_ns
    if state.command_age_ns < 20e6:  # an older command must not act: a device lets go
        greatest_N = max(greatest_N, command.force_H_W_N[2])
print(f"my glove pushes back with up to {greatest_N:.2f} N")
