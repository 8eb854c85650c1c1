#!/usr/bin/env python3
# A wall that one can feel, from Python: a simulated hand presses a box on a plate for two seconds.
import glissade


def at(z):
    return [0, 0, z, 1, 0, 0, 0]


scene = glissade.Scene()
scene.rules = glissade.SlidingRules.real_time()
scene.add("wall", glissade.Mesh.shape("plate"))
scene.add("box", glissade.Mesh.shape("box", size_x_m=0.04, size_y_m=0.04, size_z_m=0.04), at(0.022), movable=True)

glove = glissade.SimulatedGlove([0, 1], [at(0.1), at(0.08)])  # 18 mm deeper than the wall lets it
greatest_N = 0.0
with glissade.HapticServer(scene, glove) as server:  # the loop runs beside this program, at 1000 Hz
    for _ in range(120):  # a renderer of 60 frames a second
        server.run_for(1 / 60)
        frame = server.frame()
        greatest_N = max(greatest_N, frame.f_W[0, 2])
print(f"The box lies at z = {frame.X_WV[0, 2, 3] * 1e3:.2f} mm, and the hand feels up to {greatest_N:.1f} N.")
