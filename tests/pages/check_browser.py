#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at pages of the site in Chromium, for who prefers light and for who prefers dark:
check_browser.py SITE. No script may fail, the page must know that scripts run, and the background
is light or dark. Exits 77 where there is no Chromium."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROBE = """<script>addEventListener("load", () => {
  const said = [getComputedStyle(document.body).backgroundColor];
  document.querySelector(".theme-toggle").click();
  said.push(getComputedStyle(document.body).backgroundColor);
  document.title = "probed " + said.join(" ");
})</script></body>"""
site = pathlib.Path(sys.argv[1])
browser = shutil.which("chromium")
if not browser or not (site / "index.html").exists():
    print("skipped: there is no Chromium, or no site")
    sys.exit(77)


def look(page: str, setting: int) -> list[str]:
    """What is wrong with a page; `setting` is what is preferred: 0 dark, 1 light."""
    path = site / page
    probe = path.with_name(f"probe_{path.name}")
    text = path.read_text(encoding="utf-8").replace("</body>", PROBE)
    probe.write_text(text, encoding="utf-8")
    with tempfile.TemporaryDirectory() as profile:
        run = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
             f"--user-data-dir={profile}", f"--blink-settings=preferredColorScheme={setting}",
             "--dump-dom", probe.as_uri()], capture_output=True, text=True, check=False, timeout=120)
    probe.unlink()
    wrong = re.findall(r"CONSOLE.*", run.stderr)
    if "no-js" in run.stdout.partition(">")[0] + run.stdout[:300]:
        wrong.append("it thinks that no script runs")
    seen = [sum(map(int, rgb)) / 3 > 128
            for rgb in re.findall(r"rgb\((\d+), (\d+), (\d+)\)", run.stdout.partition("</title>")[0])]
    light = setting == 1
    if seen != [light, not light]:
        wrong.append(f"light before and after the button: {seen}")
    return wrong


pages = ["index.html", "docs/gallery.html", "reference/python.html"]
failed = [f"{page}, {'dark' if setting == 0 else 'light'}: {what}"
          for page in pages for setting in (0, 1) for what in look(page, setting)]
print("\n".join(failed) or f"{len(pages)} pages are well")
sys.exit(1 if failed else 0)
