# SPDX-License-Identifier: Apache-2.0
"""What tools/build_docs and tools/check_docs share: the files of the repository, and running Doxygen on the installed headers."""

import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARY = "src/dismantle/"


def repository_files(*patterns):
    """The files of the repository that match a pattern of git, those that are not committed yet too."""
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", *patterns], cwd=ROOT, check=True, text=True,
                           capture_output=True).stdout.split("\n")
    return [name for name in names if name and (ROOT / name).is_file()]


def private_headers():
    """The headers that are not installed: those that a component's CMakeLists.txt names after PRIVATE_HEADERS."""
    for name in repository_files(LIBRARY + "**/CMakeLists.txt"):
        text = (ROOT / name).read_text(encoding="utf-8")
        for headers in re.findall(r"PRIVATE_HEADERS((?:\s+[\w/]+\.h)+)", text):
            yield from ((ROOT / name).parent / header for header in headers.split())


def components():
    """The components of the library: folder below src/dismantle -> (name, names of the components that it depends on)."""
    found = {}
    for name in repository_files(LIBRARY + "**/CMakeLists.txt"):
        text = (ROOT / name).read_text(encoding="utf-8")
        call = re.search(r"dismantle_component\((\w+)([^()]*)\)", text)
        if call:
            depends = re.search(r"\bDEPENDS((?:\s+[a-z][a-z_]*)*)", call.group(2))
            folder = str(pathlib.PurePosixPath(name).parent).removeprefix(LIBRARY)
            found[folder] = (call.group(1), depends.group(1).split() if depends else [])
    return found


def require_programs():
    """Ends the program with a message where a program that builds the documentation is missing."""
    for program in ("doxygen", "mkdocs"):
        if shutil.which(program) is None:
            sys.exit(f"{program} is not installed (it builds the documentation); run tools/install_packages check")


def run_doxygen(settings):
    """Runs Doxygen with docs/Doxyfile and further settings, a dict; gives its messages, with paths from the repository's root."""
    text = (ROOT / "docs" / "Doxyfile").read_text(encoding="utf-8")
    text += f"\nEXCLUDE = {' '.join(str(header.relative_to(ROOT)) for header in private_headers())}\n"
    text += "".join(f"{name} = {value}\n" for name, value in settings.items())
    run = subprocess.run(["doxygen", "-"], cwd=ROOT, check=False, input=text, text=True, capture_output=True)
    return [line for line in run.stderr.replace(f"{ROOT}/", "").split("\n") if line.strip()]
