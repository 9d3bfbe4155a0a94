# SPDX-License-Identifier: Apache-2.0
import dismantle
import numpy as np
import pytest
from conftest import HOME, at


def test_records_a_drag_and_undoes_it(states):
    session = dismantle.Session(states)
    session.hold("front")
    for k in range(1, 11):
        session.drag(at(5 * k, 0, 0), time=0.1 * k)
    assert session.release()
    assert np.array_equal(session.poses[1], at(50, 0, 0))
    path = session.recording
    assert [m.components for m in path.moves] == [["front"]]
    assert path.moves[0].poses.shape == (len(path.moves[0].times), 7)
    assert np.array_equal(path.moves[0].poses[-1], at(50, 0, 0))
    assert dismantle.audit(states.assembly, path).holds
    session.undo()
    assert np.array_equal(session.poses[1], HOME)
    session.redo()
    assert np.array_equal(session.poses[1], at(50, 0, 0))
    session.reset()
    assert session.recording.moves == []


def test_forgets_a_drag_that_is_cancelled(states):
    session = dismantle.Session(states)
    session.response = "stop"
    assert session.response == "stop"
    session.hold("front")
    session.drag(at(30, 0, 0))
    session.cancel_drag()
    assert np.array_equal(session.poses[1], HOME)
    assert not session.release()


def test_takes_out_and_puts_back(states):
    session = dismantle.Session(states)
    with pytest.raises(dismantle.UsageError, match="cannot be taken out straight"):
        session.take_out("back")
    free = [d for d in session.free_directions("front") if d.free]
    assert [d.direction.tolist() for d in free] == [[1, 0, 0]]
    assert session.take_out("front")
    assert session.take_out("back", direction=[1, 0, 0])
    assert session.removed == ["back", "front"]
    assert session.put_back("back")
    assert session.removed == ["front"]
    assert dismantle.audit(states.assembly, session.recording).holds


def test_refuses_invalid_arguments(states):
    session = dismantle.Session(states)
    for call, why in [
        (lambda: session.drag(HOME), "no component is held"),
        (lambda: session.hold([]), "no component is named"),
        (lambda: session.undo(), "undo|take back|nothing"),
        (lambda: session.take_out("front", direction=[0, 0, 0]), "the direction is zero"),
        (lambda: session.take_out("front", direction=[1, 0]), "not three numbers"),
    ]:
        with pytest.raises(dismantle.UsageError, match=why):
            call()
