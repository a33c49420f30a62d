#!/usr/bin/env python3
"""Draws the pictures of docs/gallery.md and of the README anew:   pictures.py PROGRAM   (make pictures)

Tests run into results/pictures and stay there; the moving picture takes results/rocks (make rocks), and is left as it is
without. The paper's study runs on a quarter of its specimen, in two minutes of CPU. Needs ffmpeg, and chromium for the report.
"""
import pathlib
import shutil
import subprocess
import sys

OUT, WORK = pathlib.Path("docs/pictures"), pathlib.Path("results/pictures")
RECIPES = {"press": "paper/press", "brazilian": "lab/brazilian", "semi-circular-bend": "lab/semi-circular-bend", "direct-shear": "lab/direct-shear"}
# picture: run, kind of figure, width [pixels]
FIGURES = {"cracks": ("press", "cracks", 1000), "anisotropy": ("press", "anisotropy", 1000), "stress_strain": ("press", "stress_strain", 800),
           "rose": ("press", "rose", 1000), "model": ("press", "model", 600), "brazilian": ("brazilian", "cracks", 800),
           "semi-circular-bend": ("semi-circular-bend", "cracks", 800), "direct-shear": ("direct-shear", "cracks", 800),
           "stiffness": ("study", "fig4", 1000), "modulus": ("study", "fig5", 1000), "strength": ("study", "fig6", 1000),
           "eq2": ("direct", "fig4", 1000)}
STUDIES = {"study": "study-small", "direct": "elastic-crossing"}
STRIP = 428  # height of the moving picture [pixels]


def run(*command, quiet=True):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE if quiet else None, stderr=subprocess.PIPE if quiet else None, text=True)
    if done.returncode > 1:  # 1: a test without a strength
        sys.exit(f"pictures: {command[0]} {command[1]} ended with {done.returncode}: {done.stderr or ''}")


def few_colours(filters, colours):
    return f"{filters},split[a][b];[a]palettegen=max_colors={colours}[p];[b][p]paletteuse=dither=none"


def encode(*arguments):
    run("ffmpeg", "-hide_banner", "-loglevel", "error", "-y", *arguments)


def shrink(large, picture, width):
    encode("-i", large, "-filter_complex", few_colours(f"scale={width}:-1:flags=area", 128), "-frames:v", 1, "-update", 1, picture)


def draw(program):
    for name, recipe in RECIPES.items():
        if not (WORK / name).exists():
            run(program, "run", f"examples/{recipe}.toml", "--out", WORK / name, quiet=False)
    for name, study in STUDIES.items():
        run(program, "study", f"examples/paper/{study}.toml", "--out", WORK / name, quiet=False)  # resumed where it is
    for name, (result, kind, width) in FIGURES.items():
        run(program, "figure", WORK / result, "--kind", kind, "--format", "png", "--out", WORK / f"{name}.png")
        shrink(WORK / f"{name}.png", OUT / f"{name}.png", width)


def photograph(program):
    """The head of a report, as a browser shows it."""
    chromium = shutil.which("chromium")
    if not chromium:
        return print("pictures: chromium is missing, report.png stays")
    run(program, "report", WORK / "press")
    run(chromium, "--headless", "--no-sandbox", "--hide-scrollbars", "--force-device-scale-factor=1", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        "--virtual-time-budget=8000", "--window-size=1600,1750", f"--screenshot={(WORK / 'page.png').resolve()}", (WORK / "press/report.html").resolve().as_uri())
    shrink(WORK / "page.png", OUT / "report.png", 1100)


def film(program):
    """Boryeong shale, first calibration: its specimens break, beside UCS of laboratory and model."""
    found = sorted(pathlib.Path("results/rocks/boryeong-shale").glob("*/calibration"))
    if not found:
        return print("pictures: no results/rocks (make rocks), boryeong.gif stays")
    run(program, "film", found[0] / "specimens", "--width", 640, "--seconds", 5, "--out", WORK / "film.webm")
    run(program, "figure", found[0], "--kind", "anisotropy", "--size", 90, "--format", "png", "--out", WORK / "chart.png")
    beside = f"[1]scale=-1:{STRIP}:flags=area[c];[0]scale=-1:{STRIP}[f];[f][c]hstack,fps=12"
    encode("-i", WORK / "film.webm", "-i", WORK / "chart.png", "-filter_complex", few_colours(beside, 96), OUT / "boryeong.gif")


if __name__ == "__main__":
    WORK.mkdir(parents=True, exist_ok=True)
    for make in (draw, photograph, film):
        make(pathlib.Path(sys.argv[1]))
