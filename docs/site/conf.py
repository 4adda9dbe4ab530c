"""Sphinx: the site from docs/*.md, the program, the package and the headers. scripts/docs sets the environment."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
OUT = Path(os.environ["HYPOFAB_SITE"])
sys.path.insert(0, str(HERE))

project = "hypofab"
author = "the authors of hypofab"
html_title = "hypofab"
root_doc = "index"
extensions = [
    "myst_nb",
    "breathe",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # MathJax itself, so that the site needs no network
    "sphinx_copybutton",
    "generated",
]

# Markdown as a forge shows it: links to headings by their text, mathematics between dollars and in blocks of its name.
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_fence_as_directive = ["math"]

# Notebooks are run whenever they are read; they are read again when the package has changed (generated.py).
nb_execution_mode = "force"
nb_execution_timeout = 120
nb_execution_show_tb = True  # of a cell that fails: a warning, and warnings are errors
nb_merge_streams = True

breathe_projects = {"hypofab": str(OUT / "doxygen/xml")}
breathe_default_project = "hypofab"
breathe_domain_by_extension = {"h": "c"}

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100
default_role = "code"

html_theme = "furo"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
copybutton_prompt_text = r">>> |\$ "
copybutton_prompt_is_regexp = True
