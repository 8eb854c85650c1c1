"""Exact collision of triangle soups, sliding contact, grasping hands, and forces for gloves.

Lengths are metres, angles radians, forces newtons. X_AB is the pose of frame B in frame A: a row x, y, z, qw, qx, qy, qz,
or a matrix (4, 4). Arrays of n poses have the shape (n, 7) or (n, 4, 4). Wrong input raises ValueError or TypeError with a
sentence that names it. For example::

    import glissade
    box = glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.06, size_z_m=0.04)
    tree = glissade.Tree(box)
    print(glissade.distance(tree, tree, [0, 0, 0.1, 1, 0, 0, 0]).distance)
"""

from glissade._glissade import (
    GLOVE_PRESETS,
    JOINT_NAMES,
    LIMIT_REASONS,
    SLIDING_STATES,
    ClosestPoints,
    Contact,
    Frame,
    Glove,
    GloveCommand,
    HandShape,
    HapticServer,
    LcmGlove,
    Mesh,
    Pipeline,
    Posture,
    Recording,
    RelayGlove,
    Scene,
    SimulatedGlove,
    Simulation,
    SlidingRules,
    Track,
    Tree,
    View,
    __version__,
    distance,
    intersects,
    lock_memory,
    pairs,
    pairs_within,
    read_recording,
    view,
    way_out,
)

__all__ = [
    "GLOVE_PRESETS",
    "JOINT_NAMES",
    "LIMIT_REASONS",
    "SLIDING_STATES",
    "ClosestPoints",
    "Contact",
    "Frame",
    "Glove",
    "GloveCommand",
    "HandShape",
    "HapticServer",
    "LcmGlove",
    "Mesh",
    "Pipeline",
    "Posture",
    "Recording",
    "RelayGlove",
    "Scene",
    "SimulatedGlove",
    "Simulation",
    "SlidingRules",
    "Track",
    "Tree",
    "View",
    "__version__",
    "distance",
    "intersects",
    "lock_memory",
    "pairs",
    "pairs_within",
    "read_recording",
    "view",
    "way_out",
]
