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

# The program in a page of its own (`make browser-lab`), where that has been made.
LAB = ROOT / "build/browser-lab/phyllite.html"
TRY = f"""```{{raw}} html
<p><b><a href="{LAB.name}">Try it here</a></b>, in your browser: calibrate Boryeong shale, or paste your own table. Nothing leaves the page.</p>
```
"""
html_extra_path = [str(LAB.parent)] if LAB.exists() else []


def offer(_, page, source):
    if page == "index" and LAB.exists():
        source[0] = source[0].replace("**If you use it**", f"{TRY}\n**If you use it**", 1)


def setup(app):
    app.connect("source-read", offer)
