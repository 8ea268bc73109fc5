# SPDX-License-Identifier: MIT
"""Builds the wheel (PEP 517) with the standard library and cmake alone.

One wheel serves every Python: it holds libgeotherm.so and Python that loads it. Settings
(`pip wheel . --config-settings NAME=VALUE`):

    library   a libgeotherm.so that was built already; otherwise cmake builds one, in build/wheel,
              without CHOLMOD, whose licence is another, and Assimp, and with all that not every
              system has linked into it
    platform  of the wheel's name; otherwise that of this Python
    cmake     further arguments for cmake, with blanks between
"""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sysconfig
import tarfile
import zipfile
from pathlib import Path
from typing import Any, Mapping, Optional

Settings = Optional[Mapping[str, Any]]

_ROOT = Path(__file__).resolve().parents[2]
_PACKAGE = _ROOT / "app/python/geotherm"
_LIBRARY = "libgeotherm.so.0"
# What every Linux with glibc has, as manylinux allows it; libpng travels along.
_EVERYWHERE = re.compile(
    r"(linux-vdso|libc|libm|libdl|librt|libpthread|libz|libpng\w*|.*/ld-linux[^.]*)\.so"
)


def _version() -> str:
    text = (_ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"project\(geotherm VERSION ([0-9.]+)", text)
    assert found, "CMakeLists.txt names no version"
    return found[1]


def _dist_info() -> str:
    return f"geotherm-{_version()}.dist-info"


def _setting(settings: Settings, name: str) -> str | None:
    value = (settings or {}).get(name)
    return str(value) if value else None


def _built_library(settings: Settings) -> Path:
    given = _setting(settings, "library")
    if given:
        return Path(given).resolve()
    build = _ROOT / "build/wheel"
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    off = ["WITH_CHOLMOD", "WITH_ASSIMP", "BUILD_ENGINE", "BUILD_APP", "BUILD_TESTS", "BUILD_BENCH"]
    configure = ["cmake", "-S", str(_ROOT), "-B", str(build), *generator]
    configure += ["-DCMAKE_BUILD_TYPE=Release", "-DGEOTHERM_FOR_WHEEL=ON"]
    configure += [f"-DGEOTHERM_{name}=OFF" for name in off]
    configure += shlex.split(_setting(settings, "cmake") or "")
    subprocess.run(configure, check=True)
    jobs = str(len(os.sched_getaffinity(0)))
    subprocess.run(
        ["cmake", "--build", str(build), "--target", "geotherm_c", "-j", jobs], check=True
    )
    return build / "lib" / _LIBRARY


def _not_everywhere(loaded: str) -> list[str]:
    """The libraries of an output of ldd that a system may lack."""
    names = [line.split()[0] for line in loaded.splitlines() if line.strip()]
    return [name for name in names if not _EVERYWHERE.match(name)]


def _libraries(settings: Settings) -> dict[str, bytes]:
    """The library, and with one that was built for a wheel the libpng that it was linked to."""
    library = _built_library(settings)
    files = {f"geotherm/{_LIBRARY}": _stripped(library)}
    if _setting(settings, "library") is None:
        needed = subprocess.run(["ldd", str(library)], check=True, capture_output=True, text=True)
        missing = _not_everywhere(needed.stdout)
        if missing:
            raise RuntimeError(f"the wheel would need {', '.join(missing)}, which it does not bring")
        for name, path in re.findall(r"(libpng\S+) => (\S+)", needed.stdout):
            files[f"geotherm/{name}"] = Path(path).read_bytes()
    return files


def _metadata() -> dict[str, bytes]:
    described = (_ROOT / "README.md").read_text(encoding="utf-8")
    return {
        "METADATA": (
            "Metadata-Version: 2.1\nName: geotherm\n"
            f"Version: {_version()}\nSummary: Geodesic distance by the heat method\n"
            "License: MIT\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
            f"Description-Content-Type: text/markdown\n\n{described}"
        ).encode(),
        "LICENSE": (_ROOT / "LICENSE").read_bytes(),
    }


def _wheel_text(tag: str) -> bytes:
    return f"Wheel-Version: 1.0\nGenerator: geotherm\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()


def _tag(settings: Settings) -> str:
    platform = _setting(settings, "platform") or sysconfig.get_platform()
    return "py3-none-" + re.sub(r"[^A-Za-z0-9]", "_", platform)


def _write_wheel(folder: str, tag: str, files: Mapping[str, bytes]) -> str:
    name = f"geotherm-{_version()}-{tag}.whl"
    info = _dist_info()
    contents = dict(files)
    for key, value in {**_metadata(), "WHEEL": _wheel_text(tag)}.items():
        contents[f"{info}/{key}"] = value
    record = io.StringIO()
    rows = csv.writer(record, lineterminator="\n")
    for path, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.writerow([path, f"sha256={digest}", len(data)])
    rows.writerow([f"{info}/RECORD", "", ""])
    contents[f"{info}/RECORD"] = record.getvalue().encode()
    with zipfile.ZipFile(Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in contents.items():
            entry = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))  # the same bytes every time
            entry.external_attr = (0o755 if ".so" in path else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    return name


def _stripped(library: Path) -> bytes:
    strip = shutil.which("strip")
    if strip is None:
        return library.read_bytes()
    made = _ROOT / "build" / "stripped.so"
    made.parent.mkdir(exist_ok=True)
    subprocess.run([strip, "--strip-unneeded", "-o", str(made), str(library)], check=True)
    data = made.read_bytes()
    made.unlink()
    return data


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Nothing but what is here."""
    return []


get_requires_for_build_sdist = get_requires_for_build_editable = get_requires_for_build_wheel


def prepare_metadata_for_build_wheel(
    metadata_directory: str, config_settings: Settings = None
) -> str:
    """What the wheel will say of itself, before there is one."""
    folder = Path(metadata_directory) / _dist_info()
    folder.mkdir()
    for name, data in {**_metadata(), "WHEEL": _wheel_text(_tag(config_settings))}.items():
        (folder / name).write_bytes(data)
    return _dist_info()


def build_wheel(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None
) -> str:
    """One wheel, py3-none-PLATFORM."""
    files = {}
    for path in sorted(_PACKAGE.rglob("*")):
        if path.suffix == ".py" or path.name == "py.typed":
            files[f"geotherm/{path.relative_to(_PACKAGE)}"] = path.read_bytes()
    for path in sorted((_ROOT / "assets/models").glob("*.ply")):
        files[f"geotherm/models/{path.name}"] = path.read_bytes()
    files.update(_libraries(config_settings))
    return _write_wheel(wheel_directory, _tag(config_settings), files)


def build_editable(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None
) -> str:
    """A wheel that leads to the package in the source tree, and puts the library beside it."""
    shutil.copyfile(_built_library(config_settings), _PACKAGE / _LIBRARY)
    return _write_wheel(
        wheel_directory,
        _tag(config_settings),
        {"geotherm_source.pth": f"{_PACKAGE.parent}\n".encode()},
    )


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """What the library and the package are built from, without what was built or is hidden."""
    base = f"geotherm-{_version()}"
    tops = ["pyproject.toml", "CMakeLists.txt", "README.md", "LICENSE", "cmake", "solver", "app"]
    left_out = re.compile(r"\.|__pycache__$|.*\.so(\.|$)")
    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz") as archive:
        for top in [*tops, "bench/models", "assets/models"]:
            archive.add(
                _ROOT / top,
                f"{base}/{top}",
                filter=lambda entry: None if left_out.match(Path(entry.name).name) else entry,
            )
        text = _metadata()["METADATA"]
        entry = tarfile.TarInfo(f"{base}/PKG-INFO")
        entry.size = len(text)
        archive.addfile(entry, io.BytesIO(text))
    return f"{base}.tar.gz"
