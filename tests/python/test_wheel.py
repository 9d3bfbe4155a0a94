# SPDX-License-Identifier: Apache-2.0
"""The wheel is built and installed in a new virtual environment, without a package index, and works there."""
import os
import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT

CODE = """
import dismantle, pathlib, sys
assert pathlib.Path(dismantle.__file__).is_relative_to(sys.prefix), dismantle.__file__
assembly = dismantle.load(sys.argv[1])
print(len(assembly), dismantle.__version__)
"""


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def environment():
    """Without the build folder on Python's path, and without a network."""
    return {**{k: v for k, v in os.environ.items() if k != "PYTHONPATH"}, "PIP_NO_INDEX": "1", "PIP_NO_CACHE_DIR": "1",
            "PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def test_a_wheel_of_the_tree_works_where_it_is_installed(tmp_path, environment):
    python = tmp_path / "venv" / "bin" / "python"
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv", env=environment)
    run(python, "-m", "pip", "wheel", ROOT, "--no-deps", "--config-settings", f"build-dir={os.environ['DISMANTLE_BUILD']}",
        "-w", tmp_path, env=environment, cwd=tmp_path)
    wheel, = tmp_path.glob("dismantle-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        assert archive.testzip() is None
        assert {"dismantle/py.typed", "dismantle/_dismantle.pyi"} <= set(archive.namelist())
    run(python, "-m", "pip", "install", wheel, env=environment, cwd=tmp_path)
    out = run(python, "-c", CODE, ROOT / "samples" / "microscope.step", env=environment, cwd=tmp_path)
    components, version = out.split()
    assert int(components) > 1 and version in wheel.name
    run(python, "-m", "pip", "uninstall", "-y", "dismantle", env=environment, cwd=tmp_path)
    assert not list((tmp_path / "venv").rglob("dismantle*"))
