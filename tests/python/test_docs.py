"""The code of docs/coming_from/python.md that uses the module gives the right answers."""

import pathlib
import re

import numpy as np

import glissade

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/coming_from/python.md"


def snippets():
    return [code for code in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.S) if "glissade." in code]


def test_coming_from_python():
    box = glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.1, size_z_m=0.1)
    X_WA, X_WB = np.eye(4), np.eye(4)
    X_WA[:3, 3] = [1, 2, 3]
    X_WB[:3, 3] = [1.15, 2, 3]
    names = {"glissade": glissade, "np": np, "vertices_A": box.vertices, "triangles_A": box.triangles, "X_WA": X_WA,
             "vertices_B": box.vertices, "triangles_B": box.triangles, "X_WB": X_WB, "path": np.stack([X_WA, X_WB])}
    seen = {}
    for code in snippets():
        exec(code, names)
        seen.update({name: names[name] for name in ["collides", "nearest", "nearest_A", "nearest_B", "distances"] if name in names})
    assert seen["collides"] is False and names["meeting"].shape == (0, 2)
    np.testing.assert_allclose([seen["nearest_A"][0], seen["nearest_B"][0]], [1.05, 1.1], atol=1e-12)
    np.testing.assert_allclose(seen["distances"], [0, 0.05], atol=1e-12)
