#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of bench/run_all and tools/make_results."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def load(name):
    """A script without an ending as a module."""
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(name).name, str(ROOT / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


sys.path.insert(0, str(ROOT / "tools"))  # what the tools import
run_all = load("bench/run_all")
make_results = load("tools/make_results")

BENCHMARK = {"area": "stones", "title": "Stones", "about": "Two of them.", "command": "printf '# seed 1\\nname\\tn\\na|b\\t2\\nc\\t3\\n'",
             "minutes": 1}
MACHINE = {"processor": "Abacus", "cores": 2, "memory_gb": 1, "system": "Debian", "compiler": "c++ 1"}


class Tables(unittest.TestCase):
    def test_tables_are_separated_by_empty_lines_and_comments_are_left_out(self):
        tables = run_all.tables_of("# seed 1\na\tb\n1\t2\n\nc\n3\n4\n# done\n")
        self.assertEqual(tables, [(["a", "b"], [["1", "2"]]), (["c"], [["3"], ["4"]])])

    def test_a_row_of_another_length_is_refused(self):
        with self.assertRaisesRegex(run_all.Failure, "1 values for 2 columns"):
            run_all.tables_of("a\tb\n1\n")

    def test_table_and_rows_of_the_entry_choose_the_result(self):
        text = "a\tb\n1\t2\n\na\tb\nx\t3\ntotal\t4\n"
        self.assertEqual(run_all.chosen_table({"table": 1, "rows": {"a": "total"}}, text), (["a", "b"], [["total", "4"]]))
        for benchmark in ({"table": 2}, {"rows": {"c": "1"}}, {"rows": {"a": "7"}}):
            with self.assertRaises(run_all.Failure):
                run_all.chosen_table(benchmark, text)


class Gpu(unittest.TestCase):
    def write(self, folder, devices):
        (folder / "machine.json").write_text(json.dumps({"gpu": "Abacus", "driver": "1", "cuda": "2", "processor": "p", "cores": 3, "date": "d",
                                                         "load": 0.1, "commit": "c"}))
        times = {"mean_ms": 2, "median_ms": 1, "p99_ms": 3, "max_ms": 4}
        play = {"scene": "s", "triangles": 5, "method": "streams", "steps": 6, "plays": 3, "equal": False, "cpu_threads": 8, "cpu": times,
                "on_device": {**times, "mean_ms": 0.5}, "max_front": 7, "max_triangle_pairs": 8}
        (folder / "devices.jsonl").write_text(json.dumps(play) + devices)
        (folder / "appends-cuda.tsv").write_text("# bench_appends, today\nvariant\tms\nlocal\t1\n")

    def test_the_section_has_every_play_and_table(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertEqual(make_results.gpu_section_of(folder), "")
            self.write(folder, "\n")
            section = make_results.gpu_section_of(folder)
        for part in ("Abacus", "DIFFERENT", "| 4.00 | 7 | 8 |", "### appends on cuda", "bench_appends, today\n\n| variant | ms |", "| local | 1 |"):
            self.assertIn(part, section)

    def test_other_files_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            self.write(pathlib.Path(name), "\n{}\n")
            with self.assertRaisesRegex(make_results.Failure, "is not what tools/gpu_check writes"):
                make_results.gpu_section_of(pathlib.Path(name))


class Mutation(unittest.TestCase):
    def test_what_no_test_kills_is_counted_by_its_verdict_and_listed_where_open(self):
        mutant = {"file": "src/dismantle/surface/a.cpp", "line": 1, "kind": "drop", "before": "x + slack", "by": "", "seconds": 3}
        entries = [dict(mutant, after="x", result="alive"), dict(mutant, after="x - slack", result="alive"), dict(mutant, after="y", result="killed")]
        verdicts = {("src/dismantle/surface/a.cpp", "x + slack", "x"): ("equivalent", "it is 0")}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertEqual(make_results.mutation_section_of(folder, verdicts), "")
            (folder / "surface.jsonl").write_text("".join(json.dumps(entry) + "\n" for entry in entries))
            section = make_results.mutation_section_of(folder, verdicts)
            for part in ("| surface | 3 | 1 | 0 | 0 | 0 | 0 | 1 | 0 | 1 |", "| surface/a.cpp:1 | `x + slack` | `x - slack` | no verdict |"):
                self.assertIn(part, section)
            (folder / "surface.jsonl").write_text("{}\n")
            with self.assertRaisesRegex(make_results.mutants.Failure, "is no record of mutants"):
                make_results.mutation_section_of(folder, verdicts)


class Fuzzing(unittest.TestCase):
    def test_runs_of_a_target_are_added_up_and_targets_without_a_run_are_named(self):
        run = {"target": "step", "program": "libFuzzer", "seconds": 600, "inputs": 70, "findings": 0, "date": "d", "commit": "c", "load": 1.5,
               "machine": MACHINE}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertEqual(make_results.fuzz_section_of(folder, ["step"]), "")
            runs = [run, dict(run, findings=1, seconds=5, inputs=1, load=3), dict(run, program="replay", commit="e")]
            (folder / "runs.jsonl").write_text("".join(json.dumps(one) + "\n" for one in runs))
            section = make_results.fuzz_section_of(folder, ["http", "step"])
            for part in ("| step | libFuzzer | 2 | 605 | 71 | 1 | d | c |", "| step | replay | 1 | 600 | 70 | 0 | d | e |", "load 1.5 to 3.0",
                         "No run is recorded of `http`."):
                self.assertIn(part, section)
            self.assertNotIn("No run", make_results.fuzz_section_of(folder, ["step"]))
            (folder / "runs.jsonl").write_text("{}\n")
            with self.assertRaisesRegex(make_results.Failure, "is not what tools/fuzz writes"):
                make_results.fuzz_section_of(folder, [])


class Commands(unittest.TestCase):
    def test_the_build_folder_is_put_in_and_patterns_become_files(self):
        words = run_all.words_of("build/release/bench/x --n 'a b' bench/benchmarks.*", pathlib.Path("/elsewhere"))
        self.assertEqual(words, ["/elsewhere/bench/x", "--n", "a b", "bench/benchmarks.json"])
        with self.assertRaisesRegex(run_all.Failure, "no file is named"):
            run_all.words_of("x nothing/*.here", pathlib.Path("/"))

    def test_every_area_has_what_a_run_and_the_page_need_and_a_name_of_its_own(self):
        benchmarks = run_all.read_benchmarks()
        for benchmark in benchmarks:
            self.assertLessEqual({"area", "title", "about", "command", "minutes"}, set(benchmark), benchmark["area"])
        for key in ("area", "title", "command"):
            self.assertEqual(len({benchmark[key] for benchmark in benchmarks}), len(benchmarks), key)


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.bench = pathlib.Path(self.folder.name)
        (self.bench / "results").mkdir()
        self.write_benchmarks([BENCHMARK, dict(BENCHMARK, area="trees", title="Trees", command="long")])
        with mock.patch.object(run_all, "machine_of", return_value=MACHINE):
            self.write_result(run_all.text_of(run_all.measure(BENCHMARK, ROOT)))

    def tearDown(self):
        self.folder.cleanup()

    def write_benchmarks(self, benchmarks):
        (self.bench / "benchmarks.json").write_text(json.dumps(benchmarks))

    def write_result(self, text, area="stones"):
        (self.bench / "results" / f"{area}.json").write_text(text)

    def run_tool(self, *arguments):
        """The exit code and what was printed on stderr."""
        stderr = io.StringIO()
        with mock.patch.object(sys, "argv", ["make_results", "--bench", str(self.bench), *arguments]):
            with contextlib.redirect_stderr(stderr):
                return make_results.main(), stderr.getvalue()

    def test_a_measured_result_becomes_a_table_with_command_and_machine(self):
        self.assertEqual(self.run_tool(), (0, ""))
        page = (self.bench / "RESULTS.md").read_text()
        for part in ("\n## Stones\nTwo of them.\n", "| name | n |\n| --- | --- |\n| a\\|b | 2 |\n| c | 3 |\n", BENCHMARK["command"],
                     "Abacus, 2 cores, 1 GB; Debian; c++ 1; load ", "- Trees (`trees`, about 1 min): `long`\n"):
            self.assertIn(part, page)
        self.assertNotIn("exit code", page)
        self.assertEqual(self.run_tool("--check"), (0, ""))

    def test_an_exit_code_that_is_not_zero_is_shown(self):
        path = self.bench / "results" / "stones.json"
        path.write_text(path.read_text().replace('"exit_code": 0', '"exit_code": 1'))
        self.run_tool()
        self.assertIn("ended with exit code 1", (self.bench / "RESULTS.md").read_text())

    def test_the_check_fails_with_one_sentence_where_the_page_was_changed_by_hand(self):
        self.run_tool()
        path = self.bench / "RESULTS.md"
        path.write_text(path.read_text().replace("| c | 3 |", "| c | 4 |"))
        code, text = self.run_tool("--check")
        self.assertEqual((code, text.count("\n")), (1, 1))
        self.assertIn("run tools/make_results", text)
        path.unlink()
        self.assertEqual(self.run_tool("--check")[0], 1)

    def test_a_result_of_another_command_or_area_or_no_json_is_refused(self):
        self.write_benchmarks([dict(BENCHMARK, command="another")])
        self.assertIn("is of another command", self.run_tool()[1])
        self.write_benchmarks([])
        self.assertIn("is of no area", self.run_tool()[1])
        self.write_result("{")
        code, text = self.run_tool("--check")
        self.assertEqual((code, text.count("\n")), (1, 1))
        self.assertIn("is no JSON", text)


if __name__ == "__main__":
    unittest.main()
