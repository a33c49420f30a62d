"""The documents as a site (`make docs`): Sphinx reads the pages as they are, MyST understands their Markdown."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
project = "Phyllite"
author = "the Phyllite authors"
version = release = re.search(r"^## (\S+),", (ROOT / "CHANGELOG.md").read_text(), re.M)[1]

extensions = ["myst_parser"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # some pages begin their sections at the third level
html_theme = "furo"
html_title = f"Phyllite {version}"
html_copy_source = False
html_show_copyright = False
html_static_path = ["."]
html_css_files = ["pages.css"]
exclude_patterns = ["site"]
