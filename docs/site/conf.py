# SPDX-License-Identifier: MIT
"""How Sphinx makes the site of the pages that pages.py puts together; scripts/site.sh calls it."""

import os

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
    (r"cpp:.*", r"EliminationTree|NodeOrder|BufferPool|(Wave|Path|Intrinsic)Surface|State|io::InputFile"),
    (r"c:.*", r"u?int\d+_t"),
    (r"py:.*", r"(np|npt|numpy|os|collections|ctypes|typing)\..*|.*AnyArray|Progress|optional"),
]


def keep_sentences(app, what, name, thing, options, lines) -> None:
    """The first line of a property is a sentence, whatever its colons; napoleon would look for a
    type in it."""
    if what == "property":
        lines[:0] = ["..", ""]


def setup(app) -> None:
    app.connect("autodoc-process-docstring", keep_sentences, priority=400)
