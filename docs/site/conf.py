# SPDX-License-Identifier: MIT
"""How Sphinx makes the site of the pages that pages.py puts together; scripts/site.sh calls it."""

import os
import pathlib
import re

import geotherm

project = "geotherm"
author = "the geotherm authors"
release = version = geotherm.__version__
copyright = "the geotherm authors, MIT licence"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
highlight_language = "text"
html_theme = "furo"
html_title = "geotherm"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sphinx = False
pygments_dark_style = "monokai"

# Pages are Markdown that code hosts show as well.
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4

breathe_projects = {name: os.path.join(os.environ["GEOTHERM_SITE_XML"], name, "xml")
                    for name in ("c", "cpp")}
breathe_default_members = ("members",)
breathe_show_include = False
breathe_domain_by_file_pattern = {"*/c/geotherm.h": "c"}

autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
napoleon_google_docstring = True
add_module_names = False

# Names of other projects, of the library's inside, and words of annotations that have no page.
nitpick_ignore_regex = [
    (r"cpp:.*", r"(std|Eigen)(::.*)?|.*_t|Vec3::(Zero|Unit[XYZ])|[TE]|Enum|Named"),
    (r"cpp:.*", r"EliminationTree|EarlierRows|NodeOrder|BufferPool|(Wave|Path|Intrinsic)Surface|State|io::InputFile"),
    (r"c:.*", r"u?int\d+_t"),
    (r"py:.*", r"(np|npt|numpy|os|collections|ctypes|typing)\..*|.*AnyArray|Progress|optional"),
]


def keep_sentences(app, what, name, thing, options, lines) -> None:
    """The first line of a property is a sentence, whatever its colons; napoleon would look for a
    type in it."""
    if what == "property":
        lines[:0] = ["..", ""]


def leave_out_script(app, page, template, context, tree) -> None:
    """The theme's, in place of which there is site.js."""
    context["script_files"] = [file for file in context["script_files"] if "furo.js" not in file]


def prefer_dark(app, error) -> None:
    """Colours of the theme's dark mode for who prefers it: as Debian ships the theme, its style sheet has
    them for those alone who have pressed the button."""
    static = pathlib.Path(app.outdir) / "_static"
    theme = (static / "styles/furo.css").read_text(encoding="utf-8")
    colours = re.search(r'body\[data-theme="dark"\]\s*\{([^}]*)\}', theme)
    if not colours:
        raise RuntimeError("furo.css has no colours of a dark mode")
    rule = "@media (prefers-color-scheme: dark) { body:not([data-theme=light]) {%s} }" % colours[1]
    with open(static / "site.css", "a", encoding="utf-8") as style:
        style.write(f"@media not print {{ {rule} }}\n")


def setup(app) -> None:
    app.connect("html-page-context", leave_out_script, priority=900)
    app.connect("build-finished", prefer_dark)
    app.connect("autodoc-process-docstring", keep_sentences, priority=400)
