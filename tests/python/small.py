"""What the tests share: a specimen of a few hundred discs, and the program."""
import importlib.util
import os
import pathlib
import subprocess

PROGRAM = os.environ["PHY_PROGRAM"]
SOURCE = pathlib.Path(os.environ["PHY_SOURCE_DIR"])

SPECIMEN = dict(specimen={"width": "8 mm", "height": "16 mm"}, packing={"n_grains": 330})
LEAST = dict(specimen={"width": "7 mm", "height": "14 mm"}, packing={"n_grains": 253})  # ten grains across
KEYS = dict(SPECIMEN, name="small", matrix={"sigma_c": "40 MPa", "tau_c": "40 MPa"}, bedding=[{"spacing": "2 mm"}],
            test={"angles": ["45 deg", "60 deg"], "intact": True, "platen_speed": "0.2 m/s"})
TEXT = """name = "small"
[specimen]
width = "8 mm"
height = "16 mm"
[packing]
n_grains = 330
[matrix]
sigma_c = "40 MPa"
tau_c = "40 MPa"
[test]
angles = ["45 deg", "60 deg"]
intact = true
platen_speed = "0.2 m/s"
[[bedding]]
spacing = "2 mm"
"""
TABLE = """theta [deg],E [GPa],nu,UCS [MPa],n
0,17.5,0.10,105,3
30,15.6,0.36,60,3
60,21.0,0.5,45,3
90,48,0.25,128,3
"""


def has(module):
    """Whether Debian's package of it is there."""
    return importlib.util.find_spec(module) is not None


def program(*arguments):
    """Exit code and output of the program."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def write(name, text):
    pathlib.Path(name).write_text(text)
    return name
