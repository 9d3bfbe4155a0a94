# SPDX-License-Identifier: Apache-2.0
"""Builds mutants and runs the tests that should notice them: the part of tools/mutate that works on the copy of the sources."""
import fcntl
import hashlib
import json
import math
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import threading

from mutants import Failure

SETTINGS = ["-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1 -g0 -DNDEBUG", "-DDISMANTLE_CONTRACTS=ON", "-DDISMANTLE_BUILD_EXAMPLES=OFF",
            "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
# A test program may take this many times as long as with the sources as they are, and --patience.
SLOWER = 4
# Further programs: target, folder of the build, arguments, the component whose sources they test.
FURTHER = [("soak_families", "bench", ["--members", "1", "--first", "1000", "--steps", "40"], "certificates")]


class Stopped(Exception):
    """The run is being ended."""


class Program:
    """A test program, and how it does with the sources as they are."""

    def __init__(self, target, folder, arguments=("--gtest_fail_fast",)):
        self.target, self.folder, self.arguments = target, folder, list(arguments)
        self.is_of_tests = target.startswith("test_")
        self.hash, self.seconds = "", {}  # seconds of processor time by arguments

    def path(self, build):
        return build / self.folder / self.target


def components_of(root):
    """Component -> those it depends on, itself and indirect ones included."""
    direct, folders = {}, {}
    for file in sorted((root / "src" / "dismantle").glob("**/CMakeLists.txt")):
        for name, body in re.findall(r"dismantle_component\(\s*(\w+)(.*?)\)", file.read_text(encoding="utf-8"), re.DOTALL):
            depends = re.search(r"\bDEPENDS\b([\w\s]*?)(?=\b[A-Z][A-Z_]+\b|$)", body)
            direct[name], folders[name] = set(depends[1].split()) if depends else set(), file.parent
    everything = {}

    def closure(name):
        if name not in everything:
            everything[name] = {name}.union(*(closure(other) for other in direct.get(name, ())))
        return everything[name]

    return {name: closure(name) for name in direct}, folders


def component_of(file, root, folders):
    """The component of a source file. Raises Failure."""
    by_folder = {folder: name for name, folder in folders.items()}
    for folder in (root / file).parents:
        if folder in by_folder:
            return by_folder[folder]
    raise Failure(f"{file} belongs to no component (no CMakeLists.txt above it calls dismantle_component); name a file of src/dismantle")


def programs_of(root):
    """All test programs, with the components that each depends on, as (Program, folder of tests, components)."""
    closures, _ = components_of(root)
    listed = re.search(r"set\(core_folders([^)]*)\)", (root / "tests" / "CMakeLists.txt").read_text(encoding="utf-8"))
    programs = []
    for file in sorted((root / "tests").glob("*/CMakeLists.txt")):
        folder = file.parent.name
        if listed and folder not in listed[1].split():
            continue
        # Below a return() is what DISMANTLE_CORE_ONLY does not build.
        text = file.read_text(encoding="utf-8").split("return()")[0]
        for name, body in re.findall(r"dismantle_test\((\w+)(.*?)\)", text, re.DOTALL):
            depends = re.search(r"\bDEPENDS\b(.*?)(?:LIBRARIES|$)", body, re.DOTALL)
            names = set().union(*(closures.get(word, set()) for word in (depends[1].split() if depends else ())))
            programs.append((Program(f"test_{name}", f"tests/{folder}"), folder, names | closures.get(folder, set())))
    for target, folder, arguments, component in FURTHER:
        if (root / folder / f"{target}.cpp").exists():
            programs.append((Program(target, folder, arguments), "", closures[component]))
    return programs


class Scratch:
    """A copy of the sources, and its build."""

    def __init__(self, source, folder, jobs):
        self.source, self.folder, self.tree, self.build, self.jobs = source, folder, folder / "tree", folder / "build", jobs
        self.running, self.stopped, self.commands, self.links = set(), False, None, {}
        self.guard, self.hashes = threading.Lock(), {}  # of objects of source files without changes
        folder.mkdir(parents=True, exist_ok=True)
        self.lock = open(folder / "lock", "w", encoding="utf-8")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise Failure(f"{folder} is in use (another tools/mutate runs); wait for its end") from error

    def copy(self):
        """Makes the copy equal to the sources; files that are equal keep their times."""
        listed = subprocess.run(["git", "ls-files", "-z", "-co", "--exclude-standard"], cwd=self.source, capture_output=True, check=True).stdout
        names = {name for name in listed.decode().split("\0") if name and (self.source / name).is_file()}
        for name in sorted(names):
            here, there = self.source / name, self.tree / name
            if not there.exists() or here.read_bytes() != there.read_bytes():
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(here, there)
                shutil.copymode(here, there)
        for path in sorted(self.tree.rglob("*")):
            if path.is_file() and str(path.relative_to(self.tree)) not in names:
                path.unlink()

    def configure(self):
        """Configures the build, once: afterwards ninja does where a CMakeLists.txt changes. Raises Failure."""
        if (self.build / "build.ninja").exists():
            return
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        command = ["cmake", "-G", "Ninja", "-S", self.tree, "-B", self.build, *SETTINGS, *launcher]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failure(f"the copy of the sources cannot be configured ({done.stderr.strip().splitlines()[-1:]}); see {self.build}")

    def make(self, target):
        """Builds a target. @return what the compiler said if it failed, else nothing"""
        code, output = self.call(["ninja", "-C", self.build, "-j", str(self.jobs), target])
        return None if code == 0 else output

    def run(self, path, arguments, limit):
        """Runs a test program for at most `limit` seconds of processor time (the load of the machine does not count), and a hundred times
        as long in all. @return its exit code (None: it took too long) and its output"""
        bound = math.ceil(limit)
        try:
            code, output = self.call(["prlimit", f"--cpu={bound}", path, *arguments], 100 * bound)
        except subprocess.TimeoutExpired:
            return None, ""
        ended = {code for number in (signal.SIGXCPU, signal.SIGKILL) for code in (-number, 128 + number)}  # directly, or in a shell
        return (None if code in ended else code), output

    def measure(self, path, arguments, limit):
        """As run(), with the seconds of processor time."""
        timed = ["-c", 'TIMEFORMAT="%U %S"; time "$@"', "bash", path, *arguments]
        code, output = self.run("bash", timed, limit)
        times = re.search(r"^([\d.]+) ([\d.]+)\s*$", output, re.MULTILINE)
        return code, output, float(times[1]) + float(times[2]) if times else math.inf

    def call(self, command, timeout=None):
        """Runs a command in the build folder. @return its exit code and its output"""
        with subprocess.Popen(command, cwd=self.build, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                              start_new_session=True) as process:
            self.running.add(process)
            try:
                if self.stopped:
                    raise Stopped
                output, _ = process.communicate(timeout=timeout)
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
                self.running.discard(process)
        if self.stopped:
            raise Stopped
        return process.returncode, output.decode(errors="replace")

    def stop(self):
        """Ends everything that runs."""
        self.stopped = True
        for process in list(self.running):
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def compile_command(self, file):
        """The words of the command that compiles a source file, without its output and input; none if it is compiled several times."""
        if self.commands is None:
            self.commands = json.loads((self.build / "compile_commands.json").read_text(encoding="utf-8"))
        found = [shlex.split(entry["command"]) for entry in self.commands if entry["file"] == str(self.tree / file)]
        return found[0][:found[0].index("-o")] if len(found) == 1 else None

    def link_command(self, target):
        """The words of the command that links a program."""
        if target not in self.links:
            done = subprocess.run(["ninja", "-C", self.build, "-t", "commands", target], capture_output=True, text=True, check=True)
            words = shlex.split(done.stdout.strip().splitlines()[-1].removeprefix(": && "))
            self.links[target] = words[:words.index("&&")]
        return self.links[target]

    @staticmethod
    def hash_of(path):
        return hashlib.sha256(path.read_bytes()).hexdigest()


def prepare(scratch, programs):
    """Builds each program from the sources as they are. Raises Failure."""
    for program in programs:
        said = scratch.make(program.target)
        if said is not None:
            raise Failure(f"{program.target} cannot be built from the sources as they are ({said.strip().splitlines()[-1]}); mend them first")
        program.hash = scratch.hash_of(program.path(scratch.build))


def measure(scratch, mutant, programs, options):
    """Runs the programs that test a file with the sources as they are, unless they have passed before. @return the runs that take at most
    --longest, as (Program, arguments). Raises Failure."""
    path, runs = scratch.build / "measured.json", []
    for program in programs:
        for arguments in runs_of(scratch, mutant, program, options):
            key = " ".join([program.hash, *arguments])
            with scratch.guard:
                known = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
            if key not in known:
                code, output, known[key] = scratch.measure(program.path(scratch.build), arguments, options.longest + options.patience)
                if code not in (0, None):
                    raise Failure(f"{program.target} fails with the sources as they are ({failed_test(output, program)}); mend them first")
                with scratch.guard:
                    known |= json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
                    path.write_text(json.dumps(known), encoding="utf-8")
                print(f"{program.target} {arguments[-1]}: {known[key]:.1f} s" + ("" if known[key] <= options.longest else ", left out"), flush=True)
            if known[key] <= options.longest:
                program.seconds[tuple(arguments)] = known[key]
                runs.append((program, arguments))
    return runs


def failed_test(output, program):
    """The first test that failed or was running at the end."""
    failed = re.findall(r"^\[  FAILED  \] ([\w./]+)", output, re.MULTILINE)
    begun = re.findall(r"^\[ RUN      \] ([\w./]+)", output, re.MULTILINE)
    return f"{program.target} {failed[0]}" if failed else f"{program.target} {begun[-1]}" if begun else program.target


def suites_of(scratch, mutant, program):
    """The test suites in the file of tests of the same name, and in those that include the mutant's file, or the header that it includes
    first."""
    first = re.search(r'^#include "(.*)"', (scratch.tree / mutant.file).read_text(encoding="utf-8"), re.MULTILINE)
    header = first[1] if first and mutant.file.endswith(".cpp") else mutant.file.removeprefix("src/")
    own = pathlib.Path(mutant.file).stem + "_test.cpp"
    texts = {path.name: path.read_text(encoding="utf-8") for path in sorted((scratch.tree / program.folder).glob("*_test.cpp"))}
    found = (re.findall(r"^TEST(?:_F|_P)?\((\w+),", text, re.MULTILINE)
             for name, text in texts.items() if name == own or f'#include "{header}"' in text)
    return sorted({suite for suites in found for suite in suites})


def runs_of(scratch, mutant, program, options):
    """The arguments of the runs of a program: first the suites of the mutant's file, then the others unless --quick; all without the
    tests of --without."""
    suites = suites_of(scratch, mutant, program) if program.is_of_tests else []
    without = [options.without] if options.without and program.is_of_tests else []
    if not suites:
        return [[*program.arguments, *(f"--gtest_filter=-{pattern}" for pattern in without)]]
    pattern = ":".join(f"{name}.*" for suite in suites for name in (suite, f"*/{suite}"))
    own, others = "-".join([pattern, *without]), "-" + ":".join([pattern, *without])
    return [[*program.arguments, f"--gtest_filter={chosen}"] for chosen in ([own] if options.quick else [own, others])]


def verdict_of_run(scratch, path, run, patience):
    """What a run of a test program says of a mutant: its result and what killed it; nothing if the tests pass."""
    program, arguments = run
    code, output = scratch.run(path, arguments, SLOWER * program.seconds[tuple(arguments)] + patience)
    if code is None:
        return "time", program.target
    return ("killed", failed_test(output, program)) if code != 0 else None


def try_in_copy(scratch, mutant, runs, patience):
    """The result of one mutant and what killed it, by writing it to the copy of the sources and building the tests."""
    path = scratch.tree / mutant.file
    original = path.read_text(encoding="utf-8")
    try:
        path.write_text(mutant.applied_to(original), encoding="utf-8")
        same = True
        for run in runs:
            program = run[0]
            if scratch.make(program.target) is not None:
                return "compiler", ""
            if scratch.hash_of(program.path(scratch.build)) == program.hash:
                continue
            same = False
            found = verdict_of_run(scratch, program.path(scratch.build), run, patience)
            if found:
                return found
        return ("same" if same else "alive"), ""
    finally:
        path.write_text(original, encoding="utf-8")


def compiled(scratch, file, text, folder):
    """The object of a source file with this text; nothing if it does not compile."""
    source, target = folder / pathlib.Path(file).name, folder / "mutant.o"
    source.write_text(text, encoding="utf-8")
    where = (scratch.tree / file).parent
    code, _ = scratch.call([*scratch.compile_command(file), f"-I{where}", f"-ffile-prefix-map={folder}={where}", "-o", target, "-c", source])
    return target if code == 0 else None


def hash_as_it_is(scratch, file, text):
    """The hash of the object of a source file without changes."""
    with scratch.guard:
        if file not in scratch.hashes:
            with tempfile.TemporaryDirectory(dir=scratch.folder) as name:
                target = compiled(scratch, file, text, pathlib.Path(name))
                scratch.hashes[file] = target and scratch.hash_of(target)
        return scratch.hashes[file]


def try_alone(scratch, mutant, runs, patience):
    """The result of one mutant and what killed it, by compiling its file alone: an object that comes before the libraries takes the place
    of that in a library."""
    original = (scratch.tree / mutant.file).read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory(dir=scratch.folder) as name:
        folder = pathlib.Path(name)
        target = compiled(scratch, mutant.file, mutant.applied_to(original), folder)
        if not target:
            return "compiler", ""
        if scratch.hash_of(target) == hash_as_it_is(scratch, mutant.file, original):
            return "same", ""
        for run in runs:
            words = list(scratch.link_command(run[0].target))
            at = words.index("-o")
            path = folder / run[0].target
            words[at:at + 2] = ["-o", path, target]
            code, output = scratch.call(words)
            if code != 0:
                raise Failure(f"{run[0].target} cannot be linked with a changed {mutant.file} ({output.strip().splitlines()[-1]}); leave it out")
            found = verdict_of_run(scratch, path, run, patience)
            if found:
                return found
    return "alive", ""
