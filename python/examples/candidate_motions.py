#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""candidate_motions.py ASSEMBLY COMPONENT: the free travel of a component along a thousand directions, and its blockers."""
import sys

import dismantle
import numpy as np


def directions(count):
    """Unit vectors spread evenly over the sphere: a Fibonacci lattice."""
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    radius = np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), z], axis=1)


def main(file, component):
    assembly = dismantle.load(file)
    states = dismantle.check(assembly)
    lower, upper = assembly.bounds
    reach = np.linalg.norm(upper - lower)

    batch = dismantle.MotionBatch(states)
    batch.set_state(component)
    units = directions(1000)
    found = batch.straight_contacts(reach * units)

    print(f"{component}: {np.count_nonzero(found.free)} of {len(units)} directions are free, on {batch.device}")
    best = np.argmax(found.toi)
    print(f"it moves {found.toi[best] * reach:.3f} mm along {np.round(units[best], 3)}")
    names = np.array(assembly.names)
    for name in np.unique(names[found.fixed[~found.free]]):
        print(f"  blocked by: {name}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(sys.argv[1], sys.argv[2])
    except dismantle.Error as error:
        sys.exit(str(error))
