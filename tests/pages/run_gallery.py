#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every command of the gallery, small, in a folder of its own: run_gallery.py PROGRAM FOLDER.
Each must end with 0, and those above which a picture stands must write it."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

SMALL = {"render": ["--size", "96x72", "--samples", "1"]}
program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
gallery = pathlib.Path(__file__).parents[2] / "docs/gallery.md"

devices = subprocess.run([program, "devices"], capture_output=True, text=True, check=False)
if devices.returncode:
    print(f"skipped: there is nothing to draw on: {devices.stderr.strip()}")
    sys.exit(1 if os.environ.get("GEOTHERM_REQUIRE_VULKAN") else 77)

shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
wrong, count = [], 0
for part in gallery.read_text(encoding="utf-8").split("\n## ")[1:]:
    for line in re.findall(r"^geotherm (.*)$", part, flags=re.M):
        words = shlex.split(line.replace("--tets 100000", "--tets 1000"))
        words += SMALL.get(words[0], [])
        run = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True,
                             check=False)
        count += 1
        if run.returncode:
            wrong.append(f"geotherm {line}: ended with {run.returncode}: {run.stderr.strip()}")
    for picture in re.findall(r"\(pictures/([^)]+)\)", part):
        if not (folder / picture).exists():
            wrong.append(f"no command writes {picture}")
print("\n".join(wrong) or f"{count} commands ended well")
sys.exit(1 if wrong or not count else 0)
