# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel for pip (PEP 517): builds the target dismantle_python with CMake and packs the module.

It needs the build packages of tools/packages.txt, and nothing from a package index. It builds in build/python;
`--config-settings build-dir=DIR` uses an existing, configured build folder.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME = "dismantle"
PARTS = ("__init__.py", "_dismantle.pyi", "py.typed")
READERS = ("dismantle-read", "dismantle-read-cad")  # programs that the module starts to read models


def _version():
    return re.search(r"project\(dismantle VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _metadata():
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\n"
            "Summary: Virtual disassembly with continuous collision handling\n"
            "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")


def _build(settings):
    """Builds the module and returns the folder of the package."""
    given = settings.get("build-dir")
    build = pathlib.Path(given).resolve() if given else ROOT / "build" / "python"
    if not given:
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DDISMANTLE_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}", "-DDISMANTLE_BUILD_TESTS=OFF",
                        "-DDISMANTLE_BUILD_BENCH=OFF", "-DDISMANTLE_BUILD_EXAMPLES=OFF"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "dismantle_python"], check=True)
    for reader in READERS:
        shutil.copy2(build / "bin" / reader, build / "python" / NAME / reader)
    return build / "python" / NAME


def _stripped(binary):
    """The bytes of a program or module, without what is for debuggers if there is a strip."""
    strip = shutil.which("strip")
    if not strip:
        return binary.read_bytes()
    stripped = binary.with_name(binary.name + ".stripped")
    subprocess.run([strip, "-S", "-o", stripped, binary], check=True)
    data = stripped.read_bytes()
    stripped.unlink()
    return data


def _files(package):
    """The contents of the wheel: {name: bytes}."""
    module = "_dismantle" + sysconfig.get_config_var("EXT_SUFFIX")
    files = {f"{NAME}/{part}": (package / part).read_bytes() for part in PARTS}
    files.update({f"{NAME}/{binary}": _stripped(package / binary) for binary in (module, *READERS)})
    info = f"{NAME}-{_version()}.dist-info"
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: dismantle\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    return files, f"{info}/RECORD"


def _record(files, record):
    lines = []
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(data)}")
    return "\n".join(lines + [f"{record},,"]) + "\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    files, record = _files(_build(config_settings or {}))
    files[record] = _record(files, record).encode()
    wheel = f"{NAME}-{_version()}-{_tag()}.whl"
    beside = pathlib.Path(wheel_directory) / (wheel + ".part")
    with zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name)  # without a time: the same input, the same wheel
            entry.external_attr = (0o755 if name.split("/")[-1] in READERS else 0o644) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    os.replace(beside, pathlib.Path(wheel_directory) / wheel)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise RuntimeError("a source archive is not made (the tree itself is the source); build a wheel")
