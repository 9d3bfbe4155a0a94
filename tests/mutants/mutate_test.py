#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/mutate, of tools/mutants.py and of the verdicts on mutants."""
import contextlib
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import mutants  # noqa: E402

SOURCES = {
    "CMakeLists.txt": """
        cmake_minimum_required(VERSION 3.25)
        project(tiny LANGUAGES CXX)
        function(dismantle_component name)
          cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
          add_library(dismantle_${name} STATIC ${arg_SOURCES})
        endfunction()
        function(dismantle_test name)
          cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
          add_executable(test_${name} ${arg_SOURCES})
          target_link_libraries(test_${name} PRIVATE dismantle_${arg_DEPENDS})
        endfunction()
        add_subdirectory(src/dismantle/fits)
        add_subdirectory(tests/fits)
        """,
    ".gitignore": "/build/\n",
    "src/dismantle/fits/CMakeLists.txt": "dismantle_component(fits SOURCES fits.cpp)\n",
    "src/dismantle/fits/fits.cpp": """
        // True where a < b.
        #include "halvings.h"
        bool fits(double size, double margin) {
          return size + margin < 10;
        }
        bool never_tested(int n) {
          return n > 3;
        }
        int halvings(unsigned n) {
          return count_halvings(n);
        }
        """,
    "src/dismantle/fits/halvings.h": """
        inline int count_halvings(unsigned n) {
          int count = 0;
          while (n > 0) n /= 2, ++count;
          return count;
        }
        """,
    "tests/CMakeLists.txt": "",
    "tests/fits/CMakeLists.txt": "dismantle_test(fits SOURCES fits_test.cpp DEPENDS fits)\n",
    "tests/fits/fits_test.cpp": r"""
        #include <cstdio>
        bool fits(double size, double margin);
        int halvings(unsigned n);
        int main() {
          std::printf("[ RUN      ] Fits.CountsTheMargin\n");
          if (!fits(8, 1) || fits(8, 3) || fits(8, 2) || halvings(4) != 3) {
            std::printf("[  FAILED  ] Fits.CountsTheMargin (0 ms)\n");
            return 1;
          }
        }
        """,
}


class Tiny:
    """A small repository with a component and its test."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        for name, text in SOURCES.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(textwrap.dedent(text).lstrip())
        subprocess.run(["git", "init", "-q"], cwd=folder, check=True)
        self.file, self.header = "src/dismantle/fits/fits.cpp", "src/dismantle/fits/halvings.h"
        self.original = {file: (self.folder / file).read_text() for file in (self.file, self.header)}
        self.copy = self.folder / "build" / "mutants" / "tree"

    def command(self, *arguments):
        return [sys.executable, "-B", str(ROOT / "tools" / "mutate"), "--source", str(self.folder), "--patience", "1", *arguments, self.file, self.header]

    def run(self, *arguments):
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False)

    def record(self):
        """Changed line -> result and what killed it."""
        lines = (self.folder / "build" / "mutants" / "results.jsonl").read_text().splitlines()
        return {entry["after"]: (entry["result"], entry["by"]) for entry in map(json.loads, lines)}


@contextlib.contextmanager
def tiny():
    with tempfile.TemporaryDirectory() as folder:
        yield Tiny(folder)


class Runs(unittest.TestCase):
    def test_mutants_that_a_test_notices_are_killed_and_others_alive(self):
        with tiny() as project:
            done = project.run("--kinds", "boundary,drop,negate")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            record = project.record()
            self.assertEqual(record["return size < 10;"], ("killed", "test_fits Fits.CountsTheMargin"))
            self.assertEqual(record["return size + margin <= 10;"], ("killed", "test_fits Fits.CountsTheMargin"))
            self.assertEqual(record["while (n >= 0) n /= 2, ++count;"], ("time", "test_fits"))
            self.assertEqual(record["return n >= 3;"], ("alive", ""))
            self.assertEqual(record["return n <= 3;"], ("alive", ""))
            self.assertIn("return n > 3;\n+ return n >= 3;", done.stdout)
            for file, text in project.original.items():
                self.assertEqual(((project.folder / file).read_text(), (project.copy / file).read_text()), (text, text))

            again = project.run("--kinds", "boundary,drop,negate")  # all are known
            self.assertEqual(again.stdout.count("fits/"), 0)
            retried = project.run("--kinds", "boundary", "--retry")  # the one that is alive
            self.assertEqual(retried.stdout.count("fits.cpp:"), 1)

            (project.folder / "tests" / "mutants").mkdir()
            (project.folder / "tests" / "mutants" / "verdicts.txt").write_text(
                f"# comment\n{project.file}\n- return n > 3;\n+ return n >= 3;\nequivalent: nobody\n  asks\n")
            judged = project.run("--kinds", "boundary", "--retry")
            self.assertEqual(judged.stdout.count("fits.cpp:"), 0)

    def test_the_copy_is_restored_when_the_run_is_ended(self):
        with tiny() as project:
            # The loop of this mutant never ends.
            process = subprocess.Popen(project.command("--kinds", "boundary"), stdout=subprocess.PIPE, text=True)
            deadline = time.monotonic() + 60
            copy = project.copy / project.header
            while not (copy.exists() and "while (n >= 0)" in copy.read_text()) and time.monotonic() < deadline:
                time.sleep(0.02)
            self.assertTrue(copy.exists() and "while (n >= 0)" in copy.read_text())
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + signal.SIGTERM)
            self.assertEqual(copy.read_text(), project.original[project.header])

    def test_a_program_that_takes_longer_than_wanted_is_left_out(self):
        with tiny() as project:
            (project.folder / "tests/fits/fits_test.cpp").write_text("int main() { for (volatile int i = 0;;) i = 1; }\n")
            done = project.run("--kinds", "drop", "--longest", "1")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("left out", done.stdout)
            self.assertEqual(project.record(), {"return size < 10;": ("alive", "")})

    def test_tests_that_are_not_wanted_do_not_run(self):
        with tiny() as project:
            test = textwrap.dedent(SOURCES["tests/fits/fits_test.cpp"]).replace("main() {", """main(int count, char** arguments) {
              for (int i = 1; i < count; ++i) if (std::strstr(arguments[i], "--gtest_filter=-Fits.*")) return 0;""")
            (project.folder / "tests/fits/fits_test.cpp").write_text("#include <cstring>\n" + test)
            for without, result in (("Other.*", ("killed", "test_fits Fits.CountsTheMargin")), ("Fits.*", ("alive", ""))):
                done = project.run("--kinds", "drop", "--without", without)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual(project.record()["return size < 10;"], result)
                (project.folder / "build" / "mutants" / "results.jsonl").unlink()

    def test_what_cannot_be_run_is_said_in_one_sentence(self):
        with tiny() as project:
            (project.folder / "tests/fits/fits_test.cpp").write_text("int main() { return 1; }\n")
            done = project.run()
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stderr, "tools/mutate: test_fits fails with the sources as they are (test_fits); mend them first\n")


def changes(text, *kinds):
    return [m.after for m in mutants.mutants_of("a.cpp", text) if m.kind in kinds]


class Changes(unittest.TestCase):
    def test_comparisons_are_moved_by_their_boundary_and_turned_round(self):
        self.assertEqual(changes("bool f() { return a < b; }", "boundary", "negate"),
                         ["bool f() { return a <= b; }", "bool f() { return a >= b; }"])

    def test_margins_are_dropped_halved_and_doubled(self):
        self.assertEqual(changes("x = gap - 2 * error(y).of[1];", "drop", "halve", "double", "factor"),
                         ["x = gap;", "x = gap - error(y).of[1];", "x = gap - 2 * (2 * error(y).of[1]);", "x = gap - 2 * (0.5 * error(y).of[1]);"])

    def test_constants_are_halved_and_doubled(self):
        self.assertEqual(changes("constexpr double kTwo = 1 + 1;", "halve", "double"),
                         ["constexpr double kTwo = 2 * (1 + 1);", "constexpr double kTwo = 0.5 * (1 + 1);"])

    def test_conditions_are_made_true_and_false(self):
        self.assertEqual(changes("if (near(a)) return;", "condition"), ["if (false) return;", "if (true) return;"])

    def test_smallest_becomes_largest(self):
        self.assertEqual(changes("x = std::min(a, max(b, c));", "min-max"), ["x = std::max(a, max(b, c));", "x = std::min(a, min(b, c));"])

    def test_what_is_no_decision_is_left_alone(self):
        for text in ("// a < b", "/* a && b */", 's = "a < b";', "#include <a - b>", "DISMANTLE_EXPECT(a < b && c + d);", "static_assert(a < b);",
                     "template <class T>", "Span<const T> f(T&& x, double margin);", "out << a;", 'throw Failure("x" + a);', "x = a[i + 1];",
                     "for (int i = 0; i < n; ++i) {}", "double tolerance = 1;"):
            self.assertEqual(changes(text, *mutants.KINDS), [], text)

    def test_a_change_over_several_lines_keeps_their_number(self):
        text = "if (a &&\n    b)\n  return;\n"
        for m in mutants.mutants_of("a.cpp", text):
            changed = text[:m.begin] + m.text + text[m.end:]
            self.assertEqual(changed.count("\n"), 3, m.after)


class Verdicts(unittest.TestCase):
    def test_every_verdict_is_on_a_mutant_of_the_sources(self):
        for (file, before, after), verdict in mutants.read_verdicts(ROOT / "tests" / "mutants" / "verdicts.txt").items():
            made = {m.key for m in mutants.mutants_of(file, (ROOT / file).read_text())}
            self.assertIn((file, before, after), made, verdict)

    def test_what_is_no_verdict_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "verdicts.txt"
            path.write_text("a.cpp\n- x\n+ y\nperhaps: who knows\n")
            with self.assertRaisesRegex(mutants.Failure, "no verdict"):
                mutants.read_verdicts(path)


if __name__ == "__main__":
    unittest.main()
