# SPDX-License-Identifier: Apache-2.0
import gc
import os
import signal
import threading

import dismantle
import numpy as np
import pytest
from conftest import ROOT, box

MICROSCOPE = ROOT / "samples" / "microscope.step"


def test_loads_a_file_and_names_its_components():
    assembly = dismantle.load(MICROSCOPE)
    assert len(assembly) == len(assembly.names) == len(assembly.components)
    assert assembly["specimen slide"].name == "specimen slide"
    assert assembly[0].name == assembly.names[0]
    assert assembly.triangle_count == sum(len(c.faces) for c in assembly.components)
    assert assembly.source_file == "microscope.step"


def test_reads_step_files_as_asked(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    fresh = dismantle.load(MICROSCOPE, cache=False)
    assert not list(tmp_path.iterdir())
    kept = [dismantle.load(MICROSCOPE, solids="join", drop_duplicates=True) for _ in range(2)]
    assert len(list((tmp_path / "dismantle").iterdir())) == 1
    assert [a.names for a in kept] == [fresh.names] * 2
    assert all(np.array_equal(a.faces, b.faces) for a, b in zip(kept[0].components, kept[1].components))
    with pytest.raises(dismantle.UsageError, match="solids 'glued' is unknown"):
        dismantle.load(MICROSCOPE, solids="glued")


def test_splits_or_joins_the_visuals_of_a_link(tmp_path):
    visual = "<visual><geometry><box size='1 1 1'/></geometry></visual>"
    file = tmp_path / "arm.urdf"
    file.write_text(f"<robot name='arm'><link name='base'>{visual * 2}</link></robot>")
    assert dismantle.load(file).names == ["base", "base#2"]
    assert dismantle.load(file, solids="join").names == ["base"]


def test_gives_meshes_without_a_copy_that_outlive_the_assembly(drawer):
    vertices, faces = drawer["back"].vertices, drawer["back"].faces
    assert vertices.shape == (8, 3) and faces.shape == (12, 3)
    assert vertices.__array_interface__["data"] == drawer["back"].vertices.__array_interface__["data"]
    assert not vertices.flags.owndata and not vertices.flags.writeable
    before = vertices.copy()
    del drawer
    gc.collect()
    assert np.array_equal(vertices, before)


def test_returns_the_meshes_that_it_was_given(drawer):
    vertices, faces = box((10, 0, 0), (20, 10, 10))
    assert np.array_equal(drawer["front"].assembled_vertices, vertices)
    assert np.array_equal(drawer["front"].faces, faces)
    assert np.array_equal(drawer["front"].transform, np.eye(4))
    assert drawer["front"].is_closed
    lower, upper = drawer.bounds
    assert lower.tolist() == [-5, -5, -5] and upper.tolist() == [20, 15, 15]


def test_accepts_meshes_of_any_number_type_and_order():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    assembly = dismantle.Assembly.from_meshes(
        {"a": (np.asfortranarray(vertices.astype(np.float32)), faces.astype(np.int64).tolist())}, units="m")
    assert np.array_equal(assembly["a"].assembled_vertices, 1000 * vertices)


@pytest.mark.parametrize("vertices, faces, why", [
    (np.zeros((3, 2)), [[0, 1, 2]], "another shape"),
    (np.zeros((3, 3)), [[0, 1, 3]], "a face has an index without a vertex"),
    (np.full((3, 3), np.nan), [[0, 1, 2]], "not finite"),
])
def test_refuses_invalid_meshes(vertices, faces, why):
    with pytest.raises(dismantle.UsageError, match=why):
        dismantle.Assembly.from_meshes({"a": (vertices, faces)})


def test_raises_each_kind_of_error_with_the_sentence_of_the_command_line(tmp_path, drawer):
    with pytest.raises(dismantle.UnreadableError, match="no such file"):
        dismantle.load(tmp_path / "missing.step")
    (tmp_path / "broken.step").write_text("this is no STEP file")
    with pytest.raises(OSError):
        dismantle.load(tmp_path / "broken.step")
    with pytest.raises(dismantle.Error, match="'lid' is unknown"):
        drawer["lid"]
    with pytest.raises(ValueError):
        drawer[99]


def test_checks_every_pair(drawer):
    states = dismantle.check(drawer, tolerance=0.01, clearance=1)
    assert states.tolerance == 0.01
    assert states.assembly is drawer
    pair = next(p for p in states.pairs if {p.a, p.b} == {"back", "front"})
    assert pair.state == "contact" and pair.distance == 0 and pair.depth < 0.001 and not pair.contained
    assert len(states) == len(states.pairs)
    assert "back" in states.report() and '"dismantle-check"' in states.report_json()
    with pytest.raises(dismantle.UsageError, match="there is no rule 'all'"):
        dismantle.check(drawer, pairs="all")
    with pytest.raises(dismantle.UsageError, match="negative"):
        dismantle.check(drawer, tolerance=-1)


def test_lets_progress_cancel_and_passes_on_its_exceptions():
    stages = []
    dismantle.load(MICROSCOPE, progress=lambda stage, fraction: stages.append(stage))
    assert stages
    with pytest.raises(dismantle.FailedError, match="cancelled"):
        dismantle.load(MICROSCOPE, progress=lambda stage, fraction: False)

    def fail(stage, fraction):
        raise KeyError(stage)

    with pytest.raises(KeyError):
        dismantle.load(MICROSCOPE, progress=fail)


def test_is_ended_by_control_c():
    interrupt = threading.Timer(0.01, lambda: os.kill(os.getpid(), signal.SIGINT))
    with pytest.raises(KeyboardInterrupt):
        interrupt.start()
        for _ in range(1000):
            dismantle.load(MICROSCOPE)
