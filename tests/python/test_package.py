"""What tools see of the package: stubs, docstrings, the version; and every line of its page."""
import ast
import contextlib
import inspect
import os
import pathlib
import re
import subprocess
import sys
import unittest
import unittest.mock
import zipfile

import phyllite
from phyllite import Recipe, _core, theory
from small import SOURCE, SPECIMEN, TABLE, has, program, write
from test_recipes import InFolder

here = pathlib.Path(phyllite.__file__).parent


def public(of):
    return {name for name in vars(of) if not name.startswith("_")}


def stub(name):
    return ast.parse((here / name).read_text()).body


class Package(InFolder):
    def test_stubs_name_all_there_is_and_nothing_else(self):
        self.assertTrue((here / "py.typed").exists())
        functions = {node.name for node in stub("theory.pyi") if isinstance(node, ast.FunctionDef)}
        self.assertEqual(functions, public(theory))
        names = {node.name for node in stub("_core.pyi") if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(names, public(_core) - {"theory"})
        for node in stub("_core.pyi"):
            if isinstance(node, ast.ClassDef):
                members = {m.name if isinstance(m, ast.FunctionDef) else m.target.id for m in node.body}
                self.assertEqual({m for m in members if not m.startswith("_")}, public(getattr(_core, node.name)),
                                 node.name)

    def test_arguments_of_stubs_are_those_of_the_functions(self):
        for node in stub("theory.pyi"):
            if isinstance(node, ast.FunctionDef):
                known = inspect.signature(getattr(theory, node.name)).parameters
                self.assertEqual([a.arg for a in node.args.args], list(known), node.name)

    def test_everything_public_says_what_it_is(self):
        for name in phyllite.__all__:
            thing = getattr(phyllite, name)
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isclass(thing) and thing.__module__.startswith("phyllite"):
                for member in public(thing):
                    value = inspect.getattr_static(thing, member)
                    if inspect.isfunction(value) or isinstance(value, property):
                        self.assertTrue(inspect.getdoc(value), f"{name}.{member}")
        for name in public(theory):
            doc = getattr(theory, name).__doc__
            self.assertRegex(doc, r"\[(Pa|deg|m|1)", name)

    def test_completion_offers_the_public_names_alone(self):
        self.assertEqual(dir(phyllite), sorted(phyllite.__all__))

    def test_signatures_name_arguments_and_keys_of_the_files(self):
        for name in phyllite.__all__:
            thing = getattr(phyllite, name)
            if inspect.isfunction(thing) or thing in (phyllite.Recipe, phyllite.Rock):
                inspect.signature(thing)
        of = lambda thing: list(inspect.signature(thing).parameters)
        self.assertEqual(of(phyllite.Rock.from_dataframe)[0], "frame")
        self.assertLessEqual({"name", "E_is", "recipe", "sheet", "columns"}, set(of(phyllite.Rock.from_dataframe)))
        self.assertLessEqual({"specimen", "packing", "matrix", "bedding", "test"}, set(of(phyllite.Recipe)))
        self.assertLessEqual({"source", "out", "vary", "packings"}, set(of(phyllite.study)))
        self.assertEqual(of(phyllite.Recipe.from_toml), ["text", "where"])
        self.assertEqual(of(phyllite.Recipe().changed), ["keys"])
        self.assertEqual(of(theory.goodman_E), ["theta", "E", "K_n_delta", "K_s_delta"])

    def test_version_is_that_of_the_program(self):
        self.assertEqual("phyllite " + phyllite.__version__, program("--version")[1].strip())

    @unittest.skipUnless(has("pip") and has("wheel"), "python3-pip, python3-setuptools and python3-wheel are missing")
    def test_a_wheel_holds_the_package(self):
        build = here.parents[1]
        done = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir",
                               self.at("wheel"), str(SOURCE)], env={**os.environ, "PHY_BUILD": str(build)},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        wheel, = pathlib.Path(self.at("wheel")).glob("phyllite-*.whl")
        self.assertIn(phyllite.__version__.split("-")[0], wheel.name)
        with zipfile.ZipFile(wheel) as packed:
            names = {pathlib.PurePath(name).name for name in packed.namelist() if name.startswith("phyllite/")}
        self.assertEqual(names, {path.name for path in here.iterdir() if path.is_file()})

    def test_the_page_and_the_package_say_nothing_that_does_not_run(self):
        page = (SOURCE / "docs/python.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertGreater(len(blocks), 2)
        names = {}
        blocks.append(inspect.cleandoc(phyllite.__doc__.split("\n\n")[1]))
        with unittest.mock.patch.object(phyllite, "Recipe", small_recipe), contextlib.chdir(self.at("")):
            write("shale.csv", TABLE)
            for code in blocks:
                exec(compile(code, "docs/python.md", "exec"), names)
        for name in re.findall(r"^\| `(\w+)", page, re.M):
            self.assertTrue(hasattr(phyllite, name), name)


def small_recipe(**keys):
    """The recipe on a few hundred discs, pressed fast."""
    keys = {**keys, **SPECIMEN, "test": {**keys.get("test", {}), "platen_speed": "0.4 m/s"}}
    if "bedding" in keys:
        keys["bedding"] = [{"spacing": "2 mm", **keys["bedding"][0]}]
    return Recipe(**keys)
