#!/usr/bin/env python3
"""Runs the program for Windows under wine, beside the one of this machine: the same bits, files, names, locks and ends.

Usage: windows_check.py [--build DIR] [--native PROGRAM] [--short] [--keep FOLDER] [CHECK...]. Without names: every check. Each prints
a line; exit code 1 if one fails, 0 with a line where wine or the program is missing. `make windows-check` runs it.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
WINE = ("/usr/lib/wine/wine64", "/usr/bin/wine64", "/usr/bin/wine")
PATIENCE = 1800  # seconds for a command: machines are shared
PRESS = {  # examples/paper/press.toml on few discs
    'width = "38 mm"': 'width = "15.2 mm"',
    'height = "76 mm" ': 'height = "30.4 mm" ',
    "n_grains = 7481": "n_grains = 1197",
    "intact = true": "intact = false",
    'platen_speed = "0.05 m/s"': 'platen_speed = "0.1 m/s"',
}
ROCK = """name = "few grains"
data = "table.csv"
grain_size = "3.2 mm"          # some 330 discs
layers = "planes"

[specimen]
width = "38 mm"
height = "76 mm"
"""
SYSTEM_LIBRARIES = {"kernel32.dll", "msvcrt.dll", "ws2_32.dll", "mswsock.dll", "bcrypt.dll", "shell32.dll", "advapi32.dll", "user32.dll"}


class Failed(Exception):
    pass


def expect(condition, why):
    if not condition:
        raise Failed(why)


class Bench:
    """A folder, the program for Windows under a wine of its own, and the native one."""
    isas, slowest = ("sse2", "avx2"), 1.1

    def __init__(self, build, native, folder, short):
        self.build, self.native, self.folder, self.short = build, native, folder, short
        self.exe = build / "phyllite.exe"
        self.wine = next((w for w in WINE if os.path.exists(w)), None)
        self.environment = dict(os.environ, WINEPREFIX=str(folder / "wine"), WINEDEBUG="-all", WINEDLLOVERRIDES="mscoree,mshtml=")
        for name in ("DISPLAY", "PHYLLITE_ISA"):
            self.environment.pop(name, None)

    def missing(self):
        if not self.wine:
            return "wine is not here (apt install wine64 wine)"
        return None if self.exe.exists() else f"{self.exe} is not there (make windows)"

    def command(self):
        return [self.wine, self.exe]

    def begin(self, *words, where=None, isa=None, **more):
        environment = dict(self.environment, **({"PHYLLITE_ISA": isa} if isa else {}))
        return subprocess.Popen([*self.command(), *words], cwd=where or self.folder, env=environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", **more)

    def windows(self, *words, code=0, **more):
        process = self.begin(*words, **more)
        said = process.communicate(timeout=PATIENCE)[0]
        expect(process.returncode == code, f"{' '.join(words)}: exit code {process.returncode}, not {code}: {said[-600:]}")
        return said

    def linux(self, *words, code=0, where=None, isa=None):
        environment = dict(os.environ, **({"PHYLLITE_ISA": isa} if isa else {}))
        done = subprocess.run([str(self.native), *words], cwd=where or self.folder, env=environment, text=True, timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        expect(done.returncode == code, f"native {' '.join(words)}: exit code {done.returncode}, not {code}: {done.stdout[-600:]}")
        return done.stdout

    def rock(self, name):
        place = self.folder / name
        place.mkdir()
        (place / "rock.toml").write_text(ROCK)
        shutil.copy(ROOT / "data/rocks/boryeong-shale/table.csv", place / "table.csv")
        return place

    def press(self, **changes):
        text = (ROOT / "examples/paper/press.toml").read_text()
        for old, new in {**PRESS, **changes}.items():
            expect(old in text, f"examples/paper/press.toml has no {old}")
            text = text.replace(old, new)
        return text + '\n[engine]\nprecision = "float"\n'


def check_program(bench):
    """One file that asks for nothing but Windows; its AVX kernels move nothing to the stack as if it were aligned."""
    headers = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", bench.exe], capture_output=True, text=True, check=True).stdout
    libraries = {name.lower() for name in re.findall(r"DLL Name: (\S+)", headers)}
    expect(libraries <= SYSTEM_LIBRARIES, f"it needs {sorted(libraries - SYSTEM_LIBRARIES)}")
    wide = 0
    for isa in ("avx2", "avx512"):
        (kernel,) = bench.build.glob(f"CMakeFiles/kernel_{isa}.dir/src/engine/*.obj")
        code = subprocess.run(["x86_64-w64-mingw32-objdump", "-d", "--no-show-raw-insn", kernel], capture_output=True, text=True, check=True).stdout
        stack = re.findall(r"\t(v?mov[a-z0-9]+) .*\(%r[sb]p", code)
        aligned = [m for m in stack if re.match(r"vmovap[sd]|vmovdqa|vmovntp|movap[sd]|movdqa", m)]
        expect(not aligned, f"{len(aligned)} aligned moves to the stack in the kernel of {isa}")
        wide += sum(m.startswith(("vmovup", "vmovdqu")) for m in stack)
    expect(wide > 100, "no vector is moved to the stack: this looks at the wrong code")
    return f"{bench.exe.stat().st_size / 1e6:.1f} MB, needs {len(libraries)} libraries of Windows; {wide} vector moves to the stack, none aligned"


def check_archive(bench):
    """What users unpack, alone in a folder: the example that its README names finds its table."""
    (archive,) = bench.build.glob("phyllite-*-windows.zip")
    with zipfile.ZipFile(archive) as zip_file:
        zip_file.extractall(bench.folder / "unpacked")
    (place,) = (bench.folder / "unpacked").iterdir()
    expect(b"\r\n" in (place / "README.txt").read_bytes(), "README.txt has no line ends of Windows")
    unpacked = Bench(place, bench.native, bench.folder, bench.short)
    said = unpacked.windows("rock", "check", "examples\\demo\\boryeong.toml", where=place)
    expect("phyllite rock check examples\\demo\\boryeong.toml --all" in said, said)
    said = unpacked.windows("rock", "new", "my rock.toml", where=place)
    expect('phyllite rock check "my rock.toml"' in said, said)
    return f"{archive.stat().st_size / 1e6:.1f} MB; its example is read, commands are quoted for cmd.exe"


def check_hash(bench):
    """The recorded numbers, with every instruction set that this processor shares."""
    words = []
    for isa in bench.isas:
        said = bench.windows("verify", "--hash", isa=isa)
        expect("all as recorded" in said, said)
        words.append(f"{isa}: {said.strip().splitlines()[-1]}")
    return "; ".join(words)


def check_verify(bench):
    """Closed forms beside the program."""
    said = bench.windows("verify")
    return said.strip().splitlines()[-1]


def differing(one, other):
    """Files that are not the same bytes, but for times, machine and lists of hashes."""
    names = lambda place: {p.relative_to(place).as_posix() for p in place.rglob("*") if p.is_file()}
    expect(names(one) == names(other), f"not the same files: {sorted(names(one) ^ names(other))}")
    return sorted(n for n in names(one) if (one / n).read_bytes() != (other / n).read_bytes())


def check_run(bench):
    """A press test: the same files. Names beyond ASCII for recipe and folder."""
    few = {"n_grains = 7481": "n_grains = 300", 'radius_min = "0.25 mm"': 'radius_min = "0.5 mm"', 'radius_max = "0.415 mm"': 'radius_max = "0.83 mm"'}
    recipe = bench.press(**(few if bench.short else {}))
    (bench.folder / "Gestein ä 岩.toml").write_text(recipe.replace('"45 deg", "60 deg", "75 deg", ', ""))
    bench.windows("--threads", "1", "run", "Gestein ä 岩.toml", "--out", "Ü b")
    bench.linux("--threads", "1", "run", "Gestein ä 岩.toml", "--out", "linux 岩")
    changed = differing(bench.folder / "Ü b", bench.folder / "linux 岩")
    times = {"report.html", "result.json", ".phyllite-files"}
    wrong = [n for n in changed if pathlib.PurePath(n).name not in times and "written" not in n]
    expect(not wrong, f"other bytes: {wrong}")
    for name in [n for n in changed if n.endswith("result.json")]:
        one, other = ((bench.folder / folder / name).read_text().splitlines() for folder in ("Ü b", "linux 岩"))
        lines = [a for a, b in zip(one, other) if a != b]
        expect(all(re.search(r"cpu|seconds|program|time|started|host", line) for line in lines), f"{name}: {lines[:3]}")
    bench.windows("--threads", "1", "run", "Gestein ä 岩.toml", "--out", "Ü b")  # takes the place of the other
    expect(not [p for p in bench.folder.rglob("*.phyllite-*")], "something in the making was left")
    return f"the same bytes but in {len(changed)} files with times"


def check_tables(bench):
    """Tables with the line ends of Windows, and a workbook."""
    place = bench.rock("tables")
    table = (place / "table.csv").read_bytes()
    native = bench.linux("rock", "check", "rock.toml", where=place)
    (place / "table.csv").write_bytes(table.replace(b"\n", b"\r\n"))
    toml = (place / "rock.toml").read_bytes()
    (place / "rock.toml").write_bytes(toml.replace(b"\n", b"\r\n"))
    # How long it takes this machine now, and the note on line ends.
    forget = lambda said: re.sub(r"takes .*|.*the file has line ends of Windows\n", "", said)
    said = bench.windows("rock", "check", "rock.toml", where=place)
    expect(forget(said) == forget(native), f"{said}\nnot\n{native}")
    books = sorted((ROOT / "tests/fuzz/seeds/workbook").glob("*.xlsx"))
    expect(books, "no workbook to read")
    read = 0
    for book in books:
        shutil.copy(book, place / "table.xlsx")
        (place / "book.toml").write_text(ROCK.replace("table.csv", "table.xlsx"))
        results = []
        for run in (bench.windows, bench.linux):
            try:
                results.append(forget(run("rock", "check", "book.toml", where=place)))
            except Failed as why:
                results.append(re.sub(r"^native ", "", str(why)))
        expect(results[0] == results[1], f"{book.name}: {results[0]}\nnot\n{results[1]}")
        read += "exit code" not in results[0]
    return f"CRLF read as LF; {read} of {len(books)} workbooks read, all as on Linux"


def check_calibrate(bench):
    """A small rock: every number of Linux, and every word."""
    place = bench.rock("small Ä")
    words = ["--threads", "2", "calibrate", "rock.toml", "--effort", "quick"]
    bench.windows(*words, "--out", "windows", where=place)
    bench.linux(*words, "--out", "linux", where=place)
    compare = [sys.executable, ROOT / "tools/compare_calibrations.py", place / "linux", place / "windows"]
    done = subprocess.run(compare, capture_output=True, text=True)
    expect(done.returncode == 0, done.stdout[-600:] + done.stderr)
    texts = [(place / of / "calibration.json").read_text().replace(run("--version").split()[-1], "VERSION")
             for of, run in (("windows", bench.windows), ("linux", bench.linux))]
    lines = [f"{a.strip()[:200]} not {b.strip()[:200]}" for a, b in zip(*(t.splitlines() for t in texts)) if a != b]
    expect(not lines, f"other words: {lines[:2]}")
    return done.stdout.strip().splitlines()[-1]


def wait_for(condition, what, seconds=300):
    end = time.time() + seconds
    while not condition():
        expect(time.time() < end, f"{what} did not come within {seconds} s")
        time.sleep(0.1)


def check_stop(bench):
    """One process works in a folder; Ctrl-C keeps what is finished; a killed one frees the folder; --resume goes on."""
    place = bench.rock("stopped")
    words = ["--threads", "1", "calibrate", "rock.toml", "--effort", "quick", "--out", "out"]
    store = place / "out/runs.sqlite"
    first = bench.begin(*words, where=place)
    wait_for(lambda: store.exists() and store.stat().st_size > 0, "the store")
    refused = bench.windows(*words, "--resume", where=place, code=2)
    expect("no other process" in refused, refused)
    time.sleep(2)
    first.send_signal(signal.SIGINT)  # which wine hands on as Ctrl-C
    said = first.communicate(timeout=PATIENCE)[0]
    expect(first.returncode == 1, f"Ctrl-C: exit code {first.returncode}: {said[-400:]}")
    kept, locked = store.stat().st_size, (place / "out/.lock").stat().st_mtime_ns
    second = bench.begin(*words, "--resume", where=place)
    wait_for(lambda: (place / "out/.lock").stat().st_mtime_ns != locked, "the lock")
    second.kill()
    second.wait()
    expect(store.stat().st_size >= kept, "the store has become smaller")
    bench.windows(*words, "--resume", where=place)
    expect((place / "out/calibration.json").exists(), "the calibration that went on wrote no result")
    return "a second process is refused, Ctrl-C ends with 1, a kill frees the folder, --resume goes on to the end"


def check_speed(bench):
    """A press test on one thread, in turns with the native program: CPU time per contact and cycle."""
    (bench.folder / "press.toml").write_text(bench.press())
    words = []
    for isa in bench.isas:
        pairs = []  # of one moment: the machine may be shared
        for turn in range(7):
            took = {}
            for run, name in ((bench.linux, "native"), (bench.windows, "windows")):
                out = bench.folder / f"speed-{isa}-{name}-{turn}"
                run("--threads", "1", "run", "press.toml", "--out", out.name, isa=isa)
                results = [json.loads(p.read_text())["run"] for p in out.rglob("result.json")]
                expect(results, f"no results in {out}")
                took[name] = sum(r["cpu_seconds"] for r in results) * 1e9 / sum(r["n_steps"] * r["n_contacts"] for r in results)
            pairs.append(took)
        ratio = statistics.median(p["windows"] / p["native"] for p in pairs)
        windows, native = (statistics.median(p[name] for p in pairs) for name in ("windows", "native"))
        expect(ratio <= bench.slowest, f"{isa}: {ratio:.2f} times the native time")
        words.append(f"{isa}: {windows:.1f} ns, {ratio:.2f} times the native {native:.1f}")
    return "; ".join(words)


class Held:
    """A file that another program of Windows has open, and shares with nobody who would replace it."""

    def __init__(self, bench, place, name):
        self.process = subprocess.Popen([bench.wine, "cmd", "/c", f"pause 2>> {name}"], cwd=place, env=bench.environment,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        expect(self.process.stdout.read(5), "the other program says nothing")

    def release(self):
        self.process.communicate(timeout=60)


def check_open_files(bench):
    """What another program has open is not replaced, and the reason told; afterwards it is."""
    place = bench.folder / "open"
    place.mkdir()
    words = ["contact", "linear", "--to", "1 um, 8 um, 0 deg", "--out", "path.csv", "--steps"]
    bench.windows(*words, "5", where=place)
    before = (place / "path.csv").read_bytes()
    held = Held(bench, place, "path.csv")
    said = bench.windows(*words, "9", where=place, code=3)
    expect("path.csv" in said and "check the permissions" in said, said)
    expect((place / "path.csv").read_bytes() == before, "the file was changed")
    held.release()
    bench.windows(*words, "9", where=place)
    expect((place / "path.csv").read_bytes() != before, "the file was not replaced")
    expect(not list(place.glob("*.phyllite-*")), "something in the making was left")
    return "refused with the reason while open, replaced afterwards"


class Gui:
    def __init__(self, bench, place):
        self.process = bench.begin("--threads", "1", "gui", place.name, "--port", "0", bufsize=1)
        line = ""
        while "http://" not in line:
            line = self.process.stdout.readline()
            expect(line, f"gui ended with {self.process.poll()}")
        found = re.search(r"(http://127\.0\.0\.1:\d+)/\?token=(\w+)", line)
        expect(found, line)
        self.address, self.token = found.groups()

    def ask(self, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, {"X-Phyllite-Token": self.token})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.read()

    def refused(self, path):
        try:
            self.ask(path)
        except urllib.error.HTTPError as why:
            return why.code in (403, 404)
        return False

    def rock(self, name="rock"):
        return json.loads(self.ask(f"/api/rock?name={name}"))["calibration"]


def check_gui(bench):
    """The page, a file with a name beyond ASCII, and a calibration that the page starts, watches and stops."""
    place = bench.rock("Seite ä")
    (place / "Tab ü.csv").write_text("a,b\n1,2\n")
    (bench.folder / "secret.csv").write_text("a,b\n1,2\n")
    (place / "out").symlink_to(bench.folder)
    gui = Gui(bench, place)
    try:
        expect(b"<html" in gui.ask("/")[:2000].lower(), "no page")
        project = json.loads(gui.ask("/api/project"))
        expect([r["name"] for r in project["rocks"]] == ["rock"], project["rocks"])
        taken = bench.windows("gui", place.name, "--port", gui.address.rsplit(":", 1)[1], code=3)
        expect("choose another --port" in taken, taken)
        expect(gui.ask("/files/Tab%20%C3%BC.csv") == b"a,b\n1,2\n", "the file is another")
        expect(gui.refused("/files/out/secret.csv"), "a link leads out of the folder")
        gui.ask("/api/calibrate", {"name": "rock", "options": {"effort": "quick"}})
        wait_for(lambda: gui.rock()["state"] == "running" and gui.rock()["progress"], "a calibration that runs")
        gui.ask("/api/stop", {"name": "rock"})
        wait_for(lambda: gui.rock()["state"] != "running", "the end of the calibration")
        state, code = gui.rock()["state"], gui.rock()["exit_code"]
        expect((state, code) == ("stopped", 1), f"{state} with {code}")
        gui.process.send_signal(signal.SIGINT)
        gui.process.communicate(timeout=60)
        return f"served, started and stopped a calibration; ended with {gui.process.returncode}"
    finally:
        if gui.process.poll() is None:
            gui.process.kill()


CHECKS = {f.__name__[6:]: f for f in (check_program, check_archive, check_hash, check_run, check_tables, check_stop, check_open_files, check_gui, check_verify, check_calibrate, check_speed)}
SHORT = ("program", "archive", "hash", "run", "tables", "stop", "gui")


def run_checks(bench, names, title):
    """1 if one fails. `title`: of its line."""
    failed = 0
    for name in names:
        begun = time.time()
        try:
            print(f"{title}: {name}: {CHECKS[name](bench)} ({time.time() - begun:.0f} s)", flush=True)
        except (Failed, subprocess.SubprocessError, OSError, ValueError) as why:
            failed += 1
            print(f"{title}: {name}: FAILED: {why}", flush=True)
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/windows")
    parser.add_argument("--native", type=pathlib.Path, default=ROOT / "build/release/phyllite")
    parser.add_argument("--keep", type=pathlib.Path, help="work here, and leave everything")
    parser.add_argument("--short", action="store_true", help=f"only {', '.join(SHORT)}, on fewer discs")
    parser.add_argument("checks", nargs="*", metavar="CHECK", help=", ".join(CHECKS))
    args = parser.parse_args()
    folder = args.keep or pathlib.Path(tempfile.mkdtemp(prefix="phyllite-windows-"))
    folder.mkdir(exist_ok=True)
    bench = Bench(args.build.resolve(), args.native.resolve(), folder.resolve(), args.short)
    if missing := bench.missing():
        print(f"windows-check: left out: {missing}")
        return 0
    try:
        bench.windows("--version")  # wine makes its folder, and says so
        return run_checks(bench, args.checks or (SHORT if args.short else CHECKS), "windows-check")
    finally:
        subprocess.run(["wineserver", "-k"], env=bench.environment, stderr=subprocess.DEVNULL, check=False)
        if not args.keep:
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
