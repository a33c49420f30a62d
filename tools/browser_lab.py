"""The page of `phyllite gui` with the program inside, as one file that needs no server, and as one with threads that needs a
server with two headers (`make browser-lab`).

    python3 tools/browser_lab.py BUILD OUT
"""

import base64
import gzip
import pathlib
import sys

LICENCES = "/usr/share/doc/emscripten/copyright"  # of the libraries that it is linked with
ROOT = pathlib.Path(__file__).parent.parent
# Nothing is asked of anybody: the program and all that it needs are in the file.
POLICY = ("default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; "
          "img-src data: blob:; connect-src 'none'; frame-src blob:; form-action 'none'; base-uri 'none'")


def block(text: str, name: str = "") -> str:
    """A script; with a name only its text, for others to take."""
    kind = f' type="text/plain" id="{name}"' if name else ""
    inert = text.replace("</script", "<\\/script").replace("<!--", "<\\!--")
    return f"<script{kind}>{inert}</script>\n"


def page(program: pathlib.Path) -> str:
    parts = ROOT / "packaging/browser"
    thread = program.with_suffix(".worker.js")
    wasm = base64.b64encode(gzip.compress(program.with_suffix(".wasm").read_bytes(), 9, mtime=0)).decode()
    texts = {
        "phyllite-program": program.with_suffix(".js").read_text(),
        "phyllite-worker": (parts / "worker.js").read_text(),
        "phyllite-wasm": wasm,
        "licences": pathlib.Path(LICENCES).read_text(),
    }
    if thread.exists():
        texts["phyllite-thread"] = thread.read_text()
    head, rest = (ROOT / "web/gui.html").read_text().split("<head>\n", 1)
    before, script = rest.rsplit("<script>", 1)
    inside = "".join(block(text, name) for name, text in texts.items()) + block((parts / "page.js").read_text())
    policy = f'<head>\n<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
    return head + policy + before + inside + "<script>" + script


def main(build: pathlib.Path, out: pathlib.Path) -> None:
    out.mkdir(parents=True, exist_ok=True)
    for program, opens in (("phyllite", "opens from the disk and from any server"), ("phyllite_threads", "computes on several threads, from a server with two headers")):
        file = out / f"{program.replace('_', '-')}.html"
        file.write_text(page(build / program))
        print(f"browser-lab: {file}, {file.stat().st_size / 1e6:.1f} MB, {opens}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
