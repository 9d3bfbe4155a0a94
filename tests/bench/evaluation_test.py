#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/make_evaluation."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LOADER = importlib.machinery.SourceFileLoader("make_evaluation", str(ROOT / "tools" / "make_evaluation"))
make_evaluation = importlib.util.module_from_spec(importlib.util.spec_from_loader(LOADER.name, LOADER))
sys.dont_write_bytecode = True
LOADER.exec_module(make_evaluation)

SETTING = {"command": "bench_paper --cores 3", "date": "2001-02-03", "processor": "Abacus", "gpu": "Slate 9", "compiler": "12", "cores": 4, "repeats": 3,
           "moves": 2, "busy_cores": 0.1, "complete": True, "equal_poses": True}
STEPS = {"assembly": "vice", "triangles": "77", "pairs": "auto", "method": "front-based", "device": "CPU", "cores": "3", "steps": "10", "reached": "9",
         "vertices_ms": "1", "refit_ms": "2", "front_ms": "3", "tests_ms": "11", "overall_ms": "17.00", "median_ms": "5", "p99_ms": "40", "longest_ms": "50",
         "within_33ms": "0.9", "plays": "3", "shortest_play_ms": "16", "longest_play_ms": "19", "embedded_steps": "0", "embedded_ms": "0"}


def steps(**values):
    return dict(STEPS, **values)


STREAMS = steps(method="streams (elementary)", overall_ms="3.400", embedded_steps="2", embedded_ms="7.5")
TABLES = {
    "table1": [STREAMS, dict(STREAMS, device="GPU", overall_ms="0.5")],
    "figure9": [STEPS, STREAMS, dict(STREAMS, device="GPU", overall_ms="0.5"), steps(method="streams (global lock)", overall_ms="5.100"),
                steps(method="boxes (discrete)", cores="1", overall_ms="0.1")],
    "cores": [steps(cores="1", overall_ms="34"), steps(cores="2")],
    "sizes": [steps(triangles="100"), steps(triangles="1000", overall_ms="170")],
    "appends": [{"variant": "global lock", "device": "GPU", "cores": "3", "start_ms": "1", "values_at_start": "20", "update_ms": "0.5", "values_at_update": "7"}],
    "tunnels": [{"case": "wall", "method": "streams", "steps": "200", "meeting": "124", "tunnels": "0", "false_stops": "0"}],
}


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.docs = pathlib.Path(self.folder.name)
        (self.docs / "evaluation").mkdir()
        (self.docs / "pictures").mkdir()
        for name, rows in TABLES.items():
            self.write(name, rows)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, rows, **setting):
        lines = [",".join(rows[0])] + [",".join(row.values()) for row in rows]
        (self.docs / "evaluation" / f"{name}.csv").write_text("\n".join(lines) + "\n")
        (self.docs / "evaluation" / f"{name}.json").write_text(json.dumps(dict(SETTING, **setting)))

    def run_tool(self, *arguments):
        """The exit code and what was printed on stderr."""
        stderr = io.StringIO()
        with mock.patch.object(sys, "argv", ["make_evaluation", "--docs", str(self.docs), *arguments]), contextlib.redirect_stderr(stderr):
            code = make_evaluation.main()
        return code, stderr.getvalue()

    def page(self):
        self.assertEqual(self.run_tool(), (0, ""))
        return (self.docs / "evaluation.md").read_text()

    def test_says_where_it_was_measured_and_what_came_out(self):
        page = self.page()
        for part in ("`bench_paper --cores 3`, 2001-02-03: Abacus, 4 cores and one Slate 9; compiler 12; other programs kept at most 0.10 cores busy; 3 plays; the first 2 moves",
                     "| vice | 77 | auto | 3 cores | 10 | 1.00 | 2.00 | 3.00 | 11.0 | 3.40 | 16.0 to 19.0 | 5.00 | 40.0 | 50.0 | 90.0% | 2 | 7.50 |",
                     "| wall | streams | 200 | 124 | 0 | 0 |", "| global lock | GPU | 1.00 | 20 | 0.500 | 7 |"):
            self.assertIn(part, page)

    def test_ratios_are_those_of_the_tables(self):
        page = self.page()
        self.assertIn("- streams (elementary) over the baseline on 3 cores: 5.00 to 5.00 times.", page)
        self.assertIn("- streams (elementary), GPU over the baseline on 3 cores: 34.0 to 34.0 times.", page)
        self.assertIn("| vice | 77 | 3 | 5.00 | 34.0 | 3.33 |", page)
        self.assertIn("| vice | 77 | 3 | 1.500 |", page)  # global lock over local
        self.assertIn("| vice | 77 | front-based | 2 | 17.0 | 2.00 |", page)  # two cores over one

    def test_charts_stand_where_the_page_shows_them(self):
        shown = re.findall(r"\]\((pictures/[^)]*\.svg)\)", self.page())
        self.assertEqual(len(shown), 3)
        for name in shown:
            self.assertTrue((self.docs / name).read_text().endswith("</svg>\n"), name)
        # The plot's ground: 364 down to 40 px; 17 and 170 between 10 and 1000.
        sizes = (self.docs / "pictures/evaluation-sizes.svg").read_text()
        self.assertIn(f'cy="{364 - 324 * 0.115224:.1f}"', sizes)
        self.assertIn(f'cy="{364 - 324 * 0.615224:.1f}"', sizes)

    def test_a_busy_machine_and_unequal_poses_are_refused(self):
        self.write("sizes", TABLES["sizes"], busy_cores=0.6)
        self.assertEqual(self.run_tool(), (1, "tools/make_evaluation: sizes was measured while other programs kept 0.6 cores busy (more than 0.5); "
                                              "measure it again on an idle machine\n"))
        self.write("sizes", TABLES["sizes"], equal_poses=False)
        self.assertIn("did not", self.run_tool()[1])
        self.assertFalse((self.docs / "evaluation.md").exists())

    def test_a_part_may_be_measured_in_pieces(self):
        self.write("figure9-rest", [dict(row, assembly="lamp") for row in TABLES["figure9"]], complete=False, moves=1, repeats=1)
        page = self.page()
        self.assertIn("| lamp | 77 | 3 | 5.00 | 34.0 | 3.33 |", page)
        self.assertIn("| vice | 77 | 3 | 5.00 | 34.0 | 3.33 |", page)
        self.assertIn("1 play; the first move of each motion; ended before it had measured all.", page)

    def test_a_part_that_was_not_measured_is_named(self):
        for ending in ("csv", "json"):
            (self.docs / "evaluation" / f"cores.{ending}").unlink()
        page = self.page()
        self.assertIn("No results are recorded of `bench_paper --only cores`.", page)
        self.assertNotIn("## Cores", page)

    def test_other_files_are_refused(self):
        (self.docs / "evaluation" / "cores.json").write_text("{}")
        code, error = self.run_tool()
        self.assertEqual(code, 1)
        self.assertIn("are not what bench_paper writes", error)

    def test_check_finds_a_page_that_is_not_up_to_date(self):
        self.page()
        self.assertEqual(self.run_tool("--check"), (0, ""))
        self.write("cores", [steps(cores="1"), steps(cores="2", overall_ms="9")])
        self.assertIn("is not what docs/evaluation gives", self.run_tool("--check")[1])


if __name__ == "__main__":
    unittest.main()
