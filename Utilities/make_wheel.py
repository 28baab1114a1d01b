# SPDX-License-Identifier: BSD-3-Clause
"""Makes a wheel, for pip: what `cmake --install` gives, without what only C++ and ParaView need.

    pip install --no-build-isolation . [--config-settings=build-dir=FOLDER]

It is built in build-wheel, or FOLDER; in a FOLDER that has been built before, nothing is. The wheel
goes with the VTK and the Python that Debian has.
"""

from __future__ import annotations

import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path
from typing import Iterator

_ROOT = Path(__file__).resolve().parent.parent
_PACKAGES = "lib/python3/dist-packages/"


def build_wheel(
    wheel_directory: str, config_settings: dict | None = None, metadata_directory: str | None = None
) -> str:
    """Make a wheel in the folder and return its name, as PEP 517 has it."""
    project = _project()
    build = Path((config_settings or {}).get("build-dir", _ROOT / "build-wheel")).absolute()
    if not (build / "CMakeCache.txt").exists():
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DNEURALMESH_BUILD_PARAVIEW_PLUGIN=OFF"]
        _cmake("-S", _ROOT, "-B", build, *options)
        _cmake("--build", build, "--parallel")
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag += f"-{tag}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    name = f"neuralmesh-{project['version']}-{tag}.whl"
    with tempfile.TemporaryDirectory() as prefix:
        for component in ("runtime", "python"):
            _cmake("--install", build, "--prefix", prefix, "--component", component)
        _write_wheel(Path(wheel_directory, name), _contents(Path(prefix), project, tag))
    return name


def _project() -> dict[str, str]:
    """Version and description, from where they stand."""
    text = (_ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    call = re.search(r'project\(NeuralMesh VERSION (\S+).*?DESCRIPTION "([^"]*)"\)', text, re.DOTALL)
    return {"version": call[1], "description": call[2]}


def _cmake(*arguments: str | Path) -> None:
    # What pip shows where something fails is on stdout.
    subprocess.run(["cmake", *arguments], check=True, stderr=subprocess.STDOUT)


def _contents(prefix: Path, project: dict[str, str], tag: str) -> Iterator[tuple[str, bytes, int]]:
    """Paths in the wheel, what is in them, and their modes."""
    release = f"neuralmesh-{project['version']}"
    for path in sorted(prefix.rglob("*")):
        # A wheel holds no links: of a library there is what programs look for, which is the link.
        if path.is_dir() or re.search(r"\.so\.\d+\.\d+\.", path.name):
            continue
        inside = path.relative_to(prefix).as_posix()
        if inside.startswith(_PACKAGES):
            inside = inside.removeprefix(_PACKAGES)
        else:
            inside = f"{release}.data/data/{inside}"
        yield inside, path.read_bytes(), path.stat().st_mode
    metadata = f"""\
Metadata-Version: 2.1
Name: neuralmesh
Version: {project['version']}
Summary: {project['description']}
License: BSD-3-Clause
Requires-Dist: numpy
"""
    wheel = f"Wheel-Version: 1.0\nGenerator: NeuralMesh\nRoot-Is-Purelib: false\nTag: {tag}\n"
    yield f"{release}.dist-info/METADATA", metadata.encode(), 0o644
    yield f"{release}.dist-info/WHEEL", wheel.encode(), 0o644


def _write_wheel(path: Path, contents: Iterator[tuple[str, bytes, int]]) -> None:
    record = ""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for inside, data, mode in contents:
            entry = zipfile.ZipInfo(inside)
            entry.external_attr = (mode | 0o100000) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{inside},sha256={digest},{len(data)}\n"
        # The record is the last one, and does not tell of itself.
        inside = f"{inside.split('/')[0]}/RECORD"
        wheel.writestr(inside, f"{record}{inside},,\n")
