# SPDX-License-Identifier: Apache-2.0
import json

import dismantle
import numpy as np
import pytest
from conftest import box

WALLS = ["floor", "roof", "left", "right", "end"]


def test_finds_the_order_and_a_path_that_passes_the_audit(states):
    plan = dismantle.plan(states, targets="back", fixed=WALLS)
    assert plan.complete and not plan.out_of_time and plan.staying == []
    assert [s.components for s in plan.steps] == [["front"], ["back"]]
    assert plan.steps[0].tier == "straight" and plan.steps[0].part_of is None
    assert np.array_equal(plan.steps[0].exit, [1, 0, 0])
    assert plan.steps[0].margin is None and plan.steps[0].nearest is None
    with_margins = dismantle.plan(states, targets="back", fixed=WALLS, margins=True)
    assert all(s.margin > 0 for s in with_margins.steps)
    path = plan.path()
    assert path.removed == ["back", "front"] or path.removed == ["front", "back"]
    report = dismantle.audit(states.assembly, path)
    assert report.holds and report.violations == []


def test_says_what_blocks_a_component(states):
    plan = dismantle.plan(states, targets=["back"], fixed=WALLS + ["front"])
    assert not plan.complete and plan.steps == []
    assert not plan.effort_spent  # it only rattles
    assert plan.staying[0].component == "back" and "back is blocked by" in str(plan.staying[0])
    why = dismantle.why(states, "back")
    assert len(why.blocked_by) == 1 and "back" in why.comes_out_with
    assert dismantle.why(states, "front").blocked_by == []


def test_takes_an_effort(states):
    for effort in (0, 0.5, 2):
        assert [s.components for s in dismantle.plan(states, targets="back", fixed=WALLS, effort=effort).steps]
    stays = {"targets": "back", "fixed": WALLS + ["front"]}
    assert dismantle.plan(states, **stays, effort=0).effort_spent
    with pytest.raises(dismantle.Error, match="effort"):
        dismantle.plan(states, effort=-1)


def test_orders_steps_by_preferences(states):
    usual = [s.components for s in dismantle.plan(states, prefer=[]).steps]
    assert usual == [s.components for s in dismantle.plan(states).steps]
    preferred = dismantle.plan(states, prefer=["groups", "support"])
    assert preferred.complete and len(preferred.steps) == len(usual)
    weighted = dismantle.plan(states, prefer=["support=1", "groups=10", "loose=0.5"])
    assert weighted.complete and len(weighted.steps) == len(usual)
    for wrong in ("beauty", "groups=0", "groups="):
        with pytest.raises(dismantle.UsageError, match="there is no such preference"):
            dismantle.plan(states, prefer=[wrong])
    with pytest.raises(dismantle.UsageError, match="names it twice"):
        dismantle.plan(states, prefer=["groups", "groups=2"])


def test_ends_early_at_its_time_limit_or_when_cancelled(states):
    assert dismantle.plan(states, time_limit=1e-6).out_of_time
    assert dismantle.plan(states, progress=lambda stage, fraction: False).out_of_time


def test_refuses_invalid_arguments(states, tmp_path):
    path = dismantle.plan(states).path()
    for call, why in [
        (lambda: dismantle.plan(states, targets="lid"), "'lid' is unknown"),
        (lambda: dismantle.plan(states, targets="back", fixed="back"), "it is both target and fixed"),
        (lambda: dismantle.plan(states, time_limit=-1), "negative"),
        (lambda: dismantle.export(states.assembly, path, tmp_path / "x.doc"), "its extension is not a known format"),
    ]:
        with pytest.raises(dismantle.UsageError, match=why):
            call()
    other = dismantle.Assembly.from_meshes({"stone": box((0, 0, 0), (1, 1, 1))})
    with pytest.raises(dismantle.UnreadableError):
        dismantle.export(other, path, tmp_path / "x.glb")
    assert not dismantle.audit(other, path).holds
    assert list(tmp_path.iterdir()) == []


def test_exports_and_reads_paths(states, tmp_path):
    path = dismantle.plan(states).path()
    path.write(tmp_path / "plan.path.json")
    assert dismantle.read_path(tmp_path / "plan.path.json") == path
    assert len(path.there_and_back().moves) == 2 * len(path.moves)
    for name in ("plan.glb", "plan.html", "plan.csv", "bom.json", "again.path.json"):
        dismantle.export(states.assembly, path, tmp_path / name)
    assert (tmp_path / "plan.glb").read_bytes()[:4] == b"glTF"
    assert b"<html" in (tmp_path / "plan.html").read_bytes()
    assert json.loads((tmp_path / "bom.json").read_text())
    assert dismantle.read_path(tmp_path / "again.path.json") == path
    dismantle.export(states.assembly, path, tmp_path / "reversed.glb", reverse=True)
    assert (tmp_path / "reversed.glb").read_bytes() != (tmp_path / "plan.glb").read_bytes()
