"""The page of `phyllite gui` with the program inside, as one file that needs no server (`make browser-lab`).

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


def main(build: pathlib.Path, out: pathlib.Path) -> None:
    parts = ROOT / "packaging/browser"
    worker = (build / "phyllite.js").read_text() + (parts / "worker.js").read_text()
    wasm = base64.b64encode(gzip.compress((build / "phyllite.wasm").read_bytes(), 9, mtime=0)).decode()
    page = (ROOT / "web/gui.html").read_text()
    head, rest = page.split("<head>\n", 1)
    before, script = rest.rsplit("<script>", 1)
    inside = block(worker, "phyllite-worker") + block(wasm, "phyllite-wasm") + block(pathlib.Path(LICENCES).read_text(), "licences") + block((parts / "page.js").read_text())
    policy = f'<head>\n<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
    out.mkdir(parents=True, exist_ok=True)
    file = out / "phyllite.html"
    file.write_text(head + policy + before + inside + "<script>" + script)
    print(f"browser-lab: {file}, {file.stat().st_size / 1e6:.1f} MB, opens from the disk and from any server")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
