"""Studies of many slides."""

import json
import pathlib
from concurrent.futures import ThreadPoolExecutor

import pytest

import glissade

SCENE = """objects:
  - {name: plate, shape: {type: holed_plate, hole_radius_m: 0.0042}}
  - {name: peg, movable: true, shape: {type: peg}, compliance_point_m: [0, 0, 0]}
"""
PATH = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.001,1,0,0,0\n0.05,0,0,-0.003,1,0,0,0\n"
STUDY = """scene: scene.yaml
part: peg
trajectory: path.csv
parameters: [{vary: path.x_m, uniform: [-0.002, 0.002]}]
slides: 20
"""


@pytest.fixture
def file(tmp_path: pathlib.Path) -> pathlib.Path:
    (tmp_path / "scene.yaml").write_text(SCENE)
    (tmp_path / "path.csv").write_text(PATH)
    (tmp_path / "study.yaml").write_text(STUDY)
    return tmp_path / "study.yaml"


def test_rows_have_the_columns(file):
    study = glissade.Study(file)
    assert len(study) == 20
    assert study.parameters == ["path.x_m"]
    row = json.loads(study.run(3))
    assert list(row) == study.columns
    assert row["slide"] == 3
    assert abs(row["path.x_m"]) < 0.002
    assert int(row["input_hash"], 16) == study.input_hash(3)


def test_rows_are_the_same_from_any_thread(file):
    study = glissade.Study(file)
    with ThreadPoolExecutor(4) as threads:
        rows = list(threads.map(study.run, range(len(study))))
    again = glissade.Study(file)
    assert [again.run(slide) for slide in reversed(range(20))] == rows[::-1]


def test_not_runs_keep_their_values(file):
    study = glissade.Study(file)
    row = json.loads(study.not_run(5, "the machine was lost"))
    assert row["problem"] == "the machine was lost"
    assert row["success"] == 0 and row["outcome"] == "not run"
    assert row["path.x_m"] == json.loads(study.run(5))["path.x_m"]


def test_wrong_input_is_told(file):
    study = glissade.Study(file)
    for wrong in (study.run, study.input_hash, lambda slide: study.not_run(slide, "")):
        for slide in (-1, 20):
            with pytest.raises(IndexError, match="20"):
                wrong(slide)
    file.write_text(STUDY.replace("slides", "slide"))
    with pytest.raises(ValueError, match=r"study.yaml:5: .*slide"):
        glissade.Study(file)
