"""A glove of another process, over LCM: run by the test python.lcm beside `glissade glove`."""

from conftest import box_on_plate

import glissade

scene = box_on_plate()
scene.rules = glissade.SlidingRules.real_time()
glove = glissade.LcmGlove(timeout_s=20)
with glissade.HapticServer(scene, glove) as server:
    for _ in range(200):
        server.run_for(0.02)
        if server.frame().held_parts == (0,):
            print("a glove of another process took hold of the box")
            break
