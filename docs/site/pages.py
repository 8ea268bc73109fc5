# SPDX-License-Identifier: MIT
"""Puts the site's pages together in a folder that looks like the source tree, so that links between
pages are the same there: pages.py FOLDER PROGRAM. What is generated: the start page (README and the
table of contents), and the reference, from the program's help and from the interfaces themselves.
Ends with 1 where a public name of the Python package has no docstring."""

import inspect
import pathlib
import re
import shutil
import subprocess
import sys
import types

import geotherm
import geotherm.compat.potpourri3d
import geotherm.compat.pygeodesic.geodesic

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = ROOT / "docs" / "reports.schema.json"


def command_line(program: str) -> str:
    """The help of each command, as the program prints it."""
    def words(*arguments: str) -> str:
        run = subprocess.run([program, *arguments], check=True, capture_output=True, text=True)
        return f"```text\n{run.stdout.rstrip()}\n```\n"

    whole = words("--help")
    commands = re.findall(r"^  ([a-z]+)  ", whole.partition("Subcommands:")[2], flags=re.M)
    if not commands:
        sys.exit("pages.py: error: the program's help lists no commands")
    page = f"# Help of every command\n\nWhat the program prints itself.\n\n## geotherm\n\n{whole}"
    for command in commands:
        page += f"\n## geotherm {command}\n\n{words(command, '--help')}"
    return page


def public_members(kind: type) -> list[str]:
    """Names that a class itself defines and does not hide."""
    return [name for name in vars(kind) if not name.startswith("_")]


def module(kind: types.ModuleType) -> str:
    """All of its __all__, each with a docstring."""
    names = kind.__all__
    bare = [name for name in names if not inspect.getdoc(getattr(kind, name))]
    for name in names:
        thing = getattr(kind, name)
        if inspect.isclass(thing):
            bare += [f"{name}.{member}" for member in public_members(thing)
                     if not inspect.getdoc(inspect.getattr_static(thing, member))]
    if bare:
        sys.exit(f"pages.py: error: no docstring in {kind.__name__}: {', '.join(bare)}")
    page = f"```{{eval-rst}}\n.. automodule:: {kind.__name__}\n\n"
    for name in sorted(names, key=str.lower):
        if inspect.isclass(getattr(kind, name)):
            page += f".. autoclass:: {kind.__name__}.{name}\n   :members:\n   :show-inheritance:\n\n"
        else:
            page += f".. autofunction:: {kind.__name__}.{name}\n\n"
    return page + "```\n"


def python() -> str:
    """The package, and the names of others in it."""
    page = "# Python\n\nHow it is used: [from Python](../docs/python.md).\n\n" + module(geotherm)
    page += "\n## In place of potpourri3d\n\n" + module(geotherm.compat.potpourri3d)
    return page + "\n## In place of pygeodesic\n\n" + module(geotherm.compat.pygeodesic.geodesic)


def cpp() -> str:
    """What each public header is about, and all that is in them."""
    page = "# C++\n\n`#include <geotherm/geotherm.h>` is all of it. Programs: [examples]"
    page += "(../docs/examples.md).\n\n| header | is about |\n| --- | --- |\n"
    for header in sorted((ROOT / "solver/include/geotherm").glob("*.h")):
        text = header.read_text(encoding="utf-8")
        about = re.search(r"((?:^//(?!/).*\n)+)namespace geotherm", text, flags=re.M)
        if about:
            words = " ".join(line.lstrip("/ ") for line in about[1].splitlines())
            words = re.sub(r"([|<_])", r"\\\1", words)
            page += f"| `geotherm/{header.name}` | {words} |\n"
    return page + "\n```{doxygennamespace} geotherm\n:project: cpp\n:members:\n```\n"


def examples() -> str:
    """The programs of docs/examples."""
    page = "# Programs\n\nEach is built and run by the tests.\n"
    for path in sorted((ROOT / "docs/examples").glob("*.c*")):
        language = "c" if path.suffix == ".c" else "cpp"
        code = path.read_text(encoding="utf-8").partition("\n")[2]
        page += f"\n## {path.name}\n\n```{language}\n{code}```\n"
    return page


def main() -> None:
    folder, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("site"))
    for name in ("CHANGELOG.md", "CONTRIBUTING.md", "LICENSE"):
        shutil.copy(ROOT / name, folder)
    contents = (ROOT / "docs/site/contents.md").read_text(encoding="utf-8")
    reference = {"commands": command_line(program), "python": python(), "cpp": cpp(),
                 "c": "# C\n\nHow it is used: [from C](../docs/c.md).\n\n"
                      "```{doxygenfile} geotherm.h\n:project: c\n```\n"}
    if SCHEMA.exists():
        reference["json"] = ("# JSON\n\nWhat every report of the program is held against:\n\n"
                             f"```json\n{SCHEMA.read_text(encoding='utf-8')}```\n")
    else:
        contents = contents.replace("reference/json\n", "")
    start = (ROOT / "README.md").read_text(encoding="utf-8").replace("(docs/examples)",
                                                                     "(docs/examples.md)")
    (folder / "index.md").write_text(f"{start}\n{contents}", encoding="utf-8")
    (folder / "docs/examples.md").write_text(examples(), encoding="utf-8")
    (folder / "reference").mkdir()
    for name, page in reference.items():
        (folder / f"reference/{name}.md").write_text(page, encoding="utf-8")


main()
