"""Every snippet of the docs that uses the module runs."""

import pathlib
import re

import numpy as np
import pytest
from conftest import at

import glissade

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
SCENES = DOCS.parent / "examples" / "scenes"


def snippets(page):
    return [code for code in re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(), re.S) if "glissade." in code]


def write_stl(mesh, path, scale):
    lines = ["solid mesh"]
    for corners in mesh.vertices[mesh.triangles] * scale:
        lines += ["facet normal 0 0 0", "outer loop", *("vertex %r %r %r" % tuple(p) for p in corners.tolist())]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid mesh\n"]))


def test_coming_from_python():
    box = glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.1, size_z_m=0.1)
    X_WA, X_WB = np.eye(4), np.eye(4)
    X_WA[:3, 3] = [1, 2, 3]
    X_WB[:3, 3] = [1.15, 2, 3]
    names = {"glissade": glissade, "np": np, "vertices_A": box.vertices, "triangles_A": box.triangles, "X_WA": X_WA,
             "vertices_B": box.vertices, "triangles_B": box.triangles, "X_WB": X_WB, "path": np.stack([X_WA, X_WB])}
    seen = {}
    for code in snippets("coming_from_python.md"):
        exec(code, names)
        seen.update({name: names[name] for name in ["collides", "nearest", "nearest_A", "nearest_B", "distances"] if name in names})
    assert seen["collides"] is False and names["meeting"].shape == (0, 2)
    np.testing.assert_allclose([seen["nearest_A"][0], seen["nearest_B"][0]], [1.05, 1.1], atol=1e-12)
    np.testing.assert_allclose(seen["distances"], [0, 0.05], atol=1e-12)


@pytest.mark.filterwarnings("ignore:SCHED_FIFO")
def test_python(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    box = glissade.Mesh.shape("box", size_x_m=0.1, size_y_m=0.1, size_z_m=0.1)
    write_stl(box, tmp_path / "door.stl", 1000)
    (tmp_path / "car_door.yaml").write_text((SCENES / "square_peg.yaml").read_text())
    start = glissade.Scene.read("car_door.yaml")
    poses = np.tile(glissade.Simulation(start).X_WG(), (3, 1, 1))
    poses[:, 2, 3] += [0, 1e-4, 2e-4]
    names = {"vertices": box.vertices, "triangles": box.triangles, "poses": poses}
    monkeypatch.setattr("webbrowser.open", lambda url: True)
    for code in snippets("python.md"):
        exec(code, names)
    assert names["recording"].hands["f_W_N"].shape[1:] == (3,)
