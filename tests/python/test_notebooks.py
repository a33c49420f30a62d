"""Every notebook is executed, the cell tagged `parameters` with settings that are small."""
import os
import pathlib
import sys
import unittest

from small import KEYS, LEAST, SOURCE, SPECIMEN

NOTEBOOKS = sorted((SOURCE / "python/notebooks").glob("*.ipynb"))
SMALL = {
    "break-a-specimen": f"keys = {dict(SPECIMEN, matrix=KEYS['matrix'], bedding=KEYS['bedding'])}",
    # its angles suffice for a model of moduli, whose strengths are those of the recipe
    "from-a-folder": f"""import phyllite, pandas
folder = "calibration"
rock = phyllite.Rock.from_dataframe(
    pandas.DataFrame({{"theta [deg]": [0, 30, 60, 90], "E [GPa]": [17.5, 15.6, 21.0, 48.0], "n": 3}}), name="my rock",
    recipe=phyllite.Recipe(**{dict(LEAST, bedding=KEYS['bedding'], matrix=KEYS['matrix'])}))
phyllite.calibrate(rock, folder, elastic=True)""",
    "calibrate-your-rock": f"settings = dict(recipe={dict(LEAST, bedding=KEYS['bedding'])}, max_tests=72)",
}


class Notebooks(unittest.TestCase):
    def test_each_has_small_settings(self):
        self.assertEqual([path.stem for path in NOTEBOOKS], sorted(SMALL))

    def test_they_run_and_draw(self):
        try:
            import ipykernel  # noqa: F401
            import matplotlib  # noqa: F401
            import nbclient
            import nbformat
            import pandas  # noqa: F401
        except ImportError as missing:
            self.skipTest(str(missing))
        for path in NOTEBOOKS:
            with self.subTest(path.stem):
                notebook = nbformat.read(path, as_version=4)
                for cell in notebook.cells:
                    self.assertFalse(cell.get("outputs"), "is committed without outputs")
                    if "parameters" in cell.metadata.get("tags", []):
                        cell.source = SMALL[path.stem]
                nbclient.NotebookClient(notebook, timeout=600, kernel_name=kernel()).execute()
                outputs = [o for cell in notebook.cells for o in cell.get("outputs", [])]
                self.assertTrue(any("image/png" in o.get("data", {}) for o in outputs))
                told = "".join(o.get("text", "") + str(o.get("data", {}).get("text/html", "")) for o in outputs)
                self.assertIn({"break-a-specimen": "intact", "calibrate-your-rock": "my rock",
                               "from-a-folder": "my rock"}[path.stem], told)


def kernel():
    """The kernel of this very Python, whatever others are installed."""
    import json

    folder = pathlib.Path(os.environ["MPLCONFIGDIR"]) / "kernels/phyllite"
    folder.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    (folder / "kernel.json").write_text(json.dumps({"argv": command, "display_name": "phyllite", "language": "python"}))
    os.environ["JUPYTER_PATH"] = str(folder.parent.parent)
    return "phyllite"
