#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""take_apart.py ASSEMBLY FOLDER: plans the disassembly, audits the path, and writes it with an animation."""
import pathlib
import sys

import dismantle


def main(file, folder):
    folder = pathlib.Path(folder)
    assembly = dismantle.load(file)
    states = dismantle.check(assembly)
    plan = dismantle.plan(states, time_limit=60)
    for number, step in enumerate(plan.steps, 1):
        print(f"{number:4}  {', '.join(step.components)}: {step.tier}")
    for explanation in plan.staying:
        print(explanation)

    path = plan.path()
    report = dismantle.audit(assembly, path)
    print(f"audit: {'holds' if report.holds else report.violations}")
    path.write(folder / "plan.path.json")
    dismantle.export(assembly, path, folder / "plan.glb")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(sys.argv[1], sys.argv[2])
    except dismantle.Error as error:
        sys.exit(str(error))
