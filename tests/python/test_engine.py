# SPDX-License-Identifier: Apache-2.0
import threading
import time

import dismantle
import numpy as np
import pytest
from conftest import HOME, at


def test_steps_until_blocked(states):
    engine = dismantle.Engine(states)
    engine.hold("back")
    assert engine.held == ["back"]
    step = engine.step(at(5, 0, 0))
    assert not step.reached and step.blocking == {"front"}
    assert np.abs(step.pose[:3]).max() <= states.tolerance
    assert step.points.shape == step.normals.shape == (len(step.gaps), 3)
    assert all(states.assembly.names[i] == "back" for i in step.moving)
    assert set(np.round(step.normals[:, 0])) == {-1}

    engine.jump(np.tile(HOME, (7, 1)))
    engine.hold(["front", "back"])
    step = engine.step(at(50, 0, 0), "touch")
    assert step.reached and np.array_equal(step.pose, at(50, 0, 0))
    assert np.array_equal(step.way[-1], step.pose)
    assert np.array_equal(engine.poses[[0, 1]], [at(50, 0, 0)] * 2)
    engine.jump(np.tile(HOME, (7, 1)))
    assert np.array_equal(engine.poses, np.tile(HOME, (7, 1)))


def test_finds_the_first_contact_of_many_candidates(states):
    engine = dismantle.Engine(states)
    engine.hold("front")
    targets = np.array([at(30, 0, 0), at(0, 30, 0), at(-30, 0, 0)])
    found = engine.first_contacts(targets)
    assert len(found) == 3
    assert found.free.tolist() == [True, False, False]
    assert found.toi[0] == 1 and found.toi[1] < 0.01
    names = states.assembly.names
    assert [names[i] for i in found.fixed[1:]] == ["right", "back"]
    assert not found.toi.flags.owndata
    assert np.array_equal(engine.poses[1], HOME), "nothing moves"
    assert len(engine.first_contacts(np.empty((0, 7)))) == 0


def test_gives_the_same_for_a_batch(states):
    batch = dismantle.MotionBatch(states, device="cpu")
    assert batch.device == "cpu"
    batch.set_state("front")
    found = batch.straight_contacts([[30, 0, 0], [0, 30, 0]])
    assert found.free.tolist() == [True, False]
    screws = batch.screw_contacts([at(30, 0, 0), at(0, 30, 0)])
    assert screws.free.tolist() == [True, False]
    away = np.tile(HOME, (7, 1))
    away[5] = at(0, 100, 0)
    batch.set_state("front", away)
    assert batch.straight_contacts([[0, 30, 0]]).free.tolist() == [True], "what was in the way is gone"


def test_gives_the_same_with_any_number_of_threads(states):
    ways = np.random.default_rng(1).normal(size=(200, 3)) * 20
    results = []
    for threads in (1, 2, 4):
        batch = dismantle.MotionBatch(states, device="cpu", threads=threads)
        batch.set_state("front")
        found = batch.straight_contacts(ways)
        results.append((found.toi.tobytes(), found.fixed[~found.free].tobytes()))
    assert results[0] == results[1] == results[2]


def test_measures_the_clearance(states):
    engine = dismantle.Engine(states)
    engine.hold("front")
    engine.step(at(14, 0, 0))
    clearance = engine.clearance()
    assert clearance.distance == pytest.approx(4)  # beyond the case's rim
    assert np.linalg.norm(clearance.point_moving - clearance.point_fixed) == pytest.approx(clearance.distance)
    assert len(engine.contacts(4.1).gaps) > 0 and len(engine.contacts(3.9).gaps) == 0


def test_refuses_invalid_arguments(states):
    engine = dismantle.Engine(states)
    for call, why in [
        (lambda: engine.step(HOME), "no component is held"),
        (lambda: engine.first_contacts([HOME]), "no component is held"),
        (lambda: engine.hold([]), "no component is named"),
        (lambda: engine.hold("lid"), "'lid' is unknown"),
        (lambda: engine.jump([HOME]), "give 7, one for each component"),
        (lambda: dismantle.MotionBatch(states).screw_contacts([HOME]), "set_state was not called"),
        (lambda: dismantle.MotionBatch(states, device="tpu"), "there is no device 'tpu'"),
        (lambda: dismantle.Engine(states, threads=-1), "number of threads cannot be used"),
    ]:
        with pytest.raises(dismantle.UsageError, match=why):
            call()
    engine.hold("front")
    for target, why in [
        ([0, 0, 0], "not seven numbers"),
        ([np.nan, 0, 0, 1, 0, 0, 0], "not finite"),
        ([0, 0, 0, 2, 0, 0, 0], "not of unit length"),
    ]:
        with pytest.raises(dismantle.UsageError, match=why):
            engine.step(target)
    with pytest.raises(dismantle.UsageError, match="there is no response 'bounce'"):
        engine.step(HOME, "bounce")
    engine.step(at(50, 0, 0))
    with pytest.raises(dismantle.UsageError, match="their poses differ"):
        engine.hold(["front", "back"])


def test_releases_the_moving_set_when_a_jump_moves_it(states):
    engine = dismantle.Engine(states)
    engine.hold("front")
    poses = engine.poses
    poses[1] = at(60, 0, 0)
    engine.jump(poses)
    assert engine.held == []
    with pytest.raises(dismantle.UsageError, match="no component is held"):
        engine.step(HOME)


def test_accepts_quaternions_that_are_unit_to_rounding(states):
    engine = dismantle.Engine(states)
    engine.hold("front")
    step = engine.step([30, 0, 0, 1 + 1e-8, 0, 0, 0])
    assert step.reached and step.pose[3] == 1


def test_works_without_the_interpreters_lock(states):
    ways = np.random.default_rng(2).normal(size=(20000, 3)) * 20
    batch = dismantle.MotionBatch(states, device="cpu", threads=1)
    batch.set_state("front")
    worker = threading.Thread(target=batch.straight_contacts, args=(ways,))
    turns = 0
    worker.start()
    while worker.is_alive():
        turns += 1
        time.sleep(0.0001)
    assert turns > 3, "this thread ran meanwhile"


def test_refuses_a_second_thread(states):
    ways = np.random.default_rng(3).normal(size=(20000, 3)) * 20
    batch = dismantle.MotionBatch(states, device="cpu", threads=1)
    batch.set_state("front")
    worker = threading.Thread(target=batch.straight_contacts, args=(ways,))
    worker.start()
    refused = False
    while worker.is_alive():
        try:
            batch.set_state("front")
        except dismantle.UsageError as error:
            refused = refused or "another thread uses it" in str(error)
    assert refused
