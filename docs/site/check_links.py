# SPDX-License-Identifier: MIT
"""Follows every link and picture of a built site that stays inside of it: check_links.py FOLDER.
Ends with 1 and the dead ones, or where there is nothing to follow."""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """What a page names and what it links to."""

    def __init__(self, path: pathlib.Path) -> None:
        super().__init__()
        self.names = {""}
        self.links: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name == "id" and value:
                self.names.add(value)
            elif name in ("href", "src") and value:
                self.links.add(value)


folder = pathlib.Path(sys.argv[1]).resolve()
pages = {path: Page(path) for path in folder.rglob("*.html")}
dead, followed = [], 0
for path, page in pages.items():
    for link in page.links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        followed += 1
        target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
        name = urllib.parse.unquote(parts.fragment)
        if not target.exists() or (target in pages and name not in pages[target].names):
            dead.append(f"{path.relative_to(folder)}: {link}")
for link in sorted(dead):
    print(link)
if dead or not followed:
    sys.exit(f"check_links.py: error: {len(dead)} of {followed} links lead nowhere")
