# SPDX-License-Identifier: Apache-2.0
import pathlib

import dismantle
import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOME = np.array([0, 0, 0, 1, 0, 0, 0], dtype=float)


def box(lower, upper):
    """The vertices and faces of an axis-aligned box."""
    corners = np.array([[(upper if i >> k & 1 else lower)[k] for k in range(3)] for i in range(8)], dtype=float)
    faces = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                      [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]], dtype=np.uint32)
    return corners, faces


def at(x, y, z):
    """A pose without rotation."""
    return np.array([x, y, z, 1, 0, 0, 0], dtype=float)


@pytest.fixture
def drawer():
    """Two boxes, one behind the other, in a case that is open towards +X."""
    return dismantle.Assembly.from_meshes({
        "back": box((0, 0, 0), (10, 10, 10)),
        "front": box((10, 0, 0), (20, 10, 10)),
        "floor": box((-5, -5, -5), (20, 15, 0)),
        "roof": box((-5, -5, 10), (20, 15, 15)),
        "left": box((-5, -5, 0), (20, 0, 10)),
        "right": box((-5, 10, 0), (20, 15, 10)),
        "end": box((-5, 0, 0), (0, 10, 10)),
    })


@pytest.fixture
def states(drawer):
    return dismantle.check(drawer)
