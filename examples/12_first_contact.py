#!/usr/bin/env python3
# A hand presses a box on a plate: the first example, from Python.
import numpy as np

import glissade

scene = glissade.Scene()
scene.add("plate", glissade.Mesh.shape("plate", size_x_m=0.4, size_y_m=0.4))
scene.add("box", glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.06, size_z_m=0.04), [0, 0, 0.03, 1, 0, 0, 0],
          movable=True)
simulation = glissade.Simulation(scene)
X_WG = [0.1, 0, 0.017, 1, 0, 0, 0]  # where the hand goes: 3 mm too deep
track = simulation.follow(np.tile(X_WG, (1000, 1)))  # a second, in milliseconds
print(f"The box lies at z = {simulation.X_WV()[2, 3] * 1e3:.4f} mm, and the hand feels {track.f_W[-1, 2]:.4f} N upwards.")
