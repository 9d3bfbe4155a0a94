# SPDX-License-Identifier: Apache-2.0
"""The documents about the module are correct: its stubs, the code in docs/python.md, the examples."""
import ast
import re
import shutil
import subprocess
import sys

import dismantle
import pytest
from conftest import ROOT, box

SAMPLE = ROOT / "samples" / "microscope.step"


def members_of_stub(node):
    names = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
    return names | {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}


def stub():
    tree = ast.parse((ROOT / "python" / "dismantle" / "_dismantle.pyi").read_text())
    classes = {n.name: n for n in tree.body if isinstance(n, ast.ClassDef)}
    functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
    return classes, functions


def is_public(name):
    return not name.startswith("_") or name in ("__init__", "__len__", "__getitem__", "__eq__")


def test_stubs_name_what_the_module_has():
    classes, functions = stub()
    public = {n for n in dir(dismantle._dismantle) if not n.startswith("_")}
    assert public == set(classes) | set(functions)


@pytest.mark.parametrize("name", sorted(n for n, node in stub()[0].items() if node.body and members_of_stub(node)))
def test_stubs_name_the_members_of(name):
    has = {n for n in vars(getattr(dismantle, name)) if is_public(n)}
    says = members_of_stub(stub()[0][name])
    if "__init__" not in says:
        has.discard("__init__")  # pybind11 has one that refuses
    assert has == says


@pytest.mark.parametrize("name", sorted(stub()[1]))
def test_stubs_have_the_arguments_of(name):
    arguments = stub()[1][name].args
    says = [a.arg for a in arguments.args + arguments.kwonlyargs]
    signature = getattr(dismantle, name).__doc__.splitlines()[0]
    assert re.findall(r"(\w+): ", signature) == says


def test_the_documents_code_runs(tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.DOTALL)
    assert len(blocks) > 3
    shutil.copy(SAMPLE, tmp_path)
    monkeypatch.chdir(tmp_path)
    namespace = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), namespace)
    assert (tmp_path / "microscope.glb").exists()


def write_obj(file, mesh):
    vertices, faces = mesh
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    file.write_text("\n".join(lines))


@pytest.mark.parametrize("example, arguments, says", [
    ("candidate_motions.py", ["lid"], "directions are free"),
    ("take_apart.py", ["."], "audit: holds"),
])
def test_the_examples_run(tmp_path, example, arguments, says):
    (tmp_path / "parts").mkdir()
    write_obj(tmp_path / "parts" / "case.obj", box((0, 0, 0), (10, 10, 10)))
    write_obj(tmp_path / "parts" / "lid.obj", box((0, 0, 10), (10, 10, 12)))
    program = [sys.executable, ROOT / "python" / "examples" / example]
    done = subprocess.run(program + ["parts"] + arguments, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert says in done.stdout
    wrong = subprocess.run(program + ["missing.step"] + arguments, cwd=tmp_path, capture_output=True, text=True)
    assert wrong.returncode == 1 and "no such file" in wrong.stderr and "Traceback" not in wrong.stderr
