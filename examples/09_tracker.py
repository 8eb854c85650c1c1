#!/usr/bin/env python3
"""A tracker in Python: tells where the hand in a glove is that measures the fingers only. This hand sways.

  lcm-gen --python --ppath types lcmtypes/*.lcm
  glissade bridge opengloves --port PORT --pose-from lcm & PYTHONPATH=types examples/09_tracker.py
"""
import math, random, socket, struct, time
from glissade import hand_pose_t

ADDRESS, HAND, RATE_HZ, SECONDS = ("239.255.76.67", 7667), 1, 90, 4
link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
link.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)  # this machine only

pose = hand_pose_t()
pose.version, pose.valid, pose.device, pose.session = hand_pose_t.VERSION, 1, HAND, random.getrandbits(62) + 1
pose.orientation_WT_wxyz = [1, 0, 0, 0]
for sequence in range(SECONDS * RATE_HZ):
    pose.sequence, pose.time_ns = sequence, time.monotonic_ns()  # when it was measured, not when it is sent
    pose.position_WT_m = [0.02 * math.sin(2 * math.pi * sequence / RATE_HZ), 0, 0.2]
    link.sendto(struct.pack(">4sI", b"LC02", sequence) + b"HAND_POSE\0" + pose.encode(), ADDRESS)
    time.sleep(1 / RATE_HZ)
