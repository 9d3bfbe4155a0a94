#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/make_large_product and bench/bench_large. Usage: large_product_test.py PROGRAM"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = sys.argv.pop(1)


def run(*words):
    return subprocess.run([str(word) for word in words], check=False, capture_output=True, text=True)


class LargeProductTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def make(self, *words):
        made = run(sys.executable, ROOT / "tools" / "make_large_product", *words)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_a_rack_is_closed_solids_that_touch_and_come_apart(self):
        rack = self.folder / "rack.glb"
        self.make("rack", rack, "--components", 29, "--shelves", 1, "--sides", 12)
        info = json.loads(run(PROGRAM, "info", rack, "--json").stdout)
        self.assertEqual(len(info["components"]), 5 + 2 * 12)
        self.assertNotIn("open", run(PROGRAM, "info", rack).stdout)
        check = run(PROGRAM, "check", rack, "--json", "--quiet")
        self.assertEqual({pair["state"] for pair in json.loads(check.stdout)["pairs"]}, {"contact"})
        plan = run(PROGRAM, "plan", rack, "-o", self.folder / "plan.path.json", "--json", "--quiet")
        self.assertEqual(plan.returncode, 0, plan.stderr)
        self.assertEqual(sum(len(step["components"]) for step in json.loads(plan.stdout)["steps"]), 4 + 2 * 12)

    def test_copies_stand_side_by_side(self):
        rack, copies = self.folder / "rack.glb", self.folder / "copies.glb"
        self.make("rack", rack, "--components", 17, "--shelves", 1, "--sides", 8)
        self.make("repeat", copies, rack, "--times", 3)
        one, three = (json.loads(run(PROGRAM, "info", file, "--json").stdout) for file in (rack, copies))
        self.assertEqual(len(three["components"]), 3 * len(one["components"]))
        pairs = [len(json.loads(run(PROGRAM, "check", file, "--json", "--quiet").stdout)["pairs"]) for file in (rack, copies)]
        self.assertEqual(pairs[1], 3 * pairs[0])

    def test_the_benchmark_prints_a_row_for_each_command(self):
        done = run(sys.executable, ROOT / "bench" / "bench_large", PROGRAM, "--sizes", "32,44", "--plan-up-to", 40)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split("\t") for line in done.stdout.splitlines()]
        self.assertEqual([row[3] for row in rows], ["command", "info", "check", "plan", "info", "check"])
        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))


if __name__ == "__main__":
    unittest.main()
