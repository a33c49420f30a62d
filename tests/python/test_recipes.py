"""Recipes and rocks: from keys, text and files alike, with the messages of the program."""
import pathlib
import tempfile
import os
import unittest

import numpy as np

import phyllite
from small import KEYS, SOURCE, SPECIMEN, TABLE, TEXT, program, write


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def at(self, name):
        return str(pathlib.Path(self.folder.name) / name)


class Recipes(InFolder):
    def test_keys_text_and_file_give_the_same_recipe_as_the_program(self):
        path = write(self.at("small.toml"), TEXT)
        completed = program("recipe", path)[1]
        for recipe in (phyllite.Recipe(**KEYS), phyllite.Recipe.from_toml(TEXT), phyllite.Recipe.from_file(path),
                       phyllite.Recipe.from_file(pathlib.Path(path))):
            self.assertEqual(recipe.to_toml(), completed)
        self.assertEqual(phyllite.Recipe(**KEYS), phyllite.Recipe.from_toml(completed))
        self.assertEqual(phyllite.Recipe.from_file(path).specimens, ["theta = 45 deg", "theta = 60 deg", "intact"])

    def test_values_are_those_of_the_file_in_SI(self):
        recipe = phyllite.Recipe(**KEYS)
        self.assertEqual(recipe["matrix.sigma_c"], 40e6)
        self.assertEqual(recipe["bedding[0].spacing"], 0.002)
        self.assertEqual(recipe["test.angles"], [45.0, 60.0])
        self.assertIs(recipe["test.intact"], True)
        self.assertEqual(recipe["packing.n_grains"], 330)
        self.assertEqual(recipe["test.kind"], "uniaxial")
        with self.assertRaisesRegex(phyllite.InputError, 'did you mean "matrix.E_c"'):
            recipe["matrix.E_d"]

    def test_numpy_and_dotted_keys_are_understood(self):
        angles = [f"{a} deg" for a in np.arange(0, 91, 45)]
        recipe = phyllite.Recipe(bedding=({},), packing={"seed": np.int64(7)},
                                 **{"test.angles": angles, "test.stop_at": np.float32(0.5), "test.intact": np.True_})
        self.assertEqual((recipe["test.angles"], recipe["test.stop_at"]), ([0.0, 45.0, 90.0], 0.5))
        self.assertEqual(recipe["packing.seed"], 7)

    def test_changed_keeps_all_else(self):
        recipe = phyllite.Recipe(**KEYS)
        other = recipe.changed(matrix={"E_c": "30 GPa"}, bedding=[{"mu": 0.5}])
        self.assertEqual((other["matrix.E_c"], other["matrix.sigma_c"]), (30e9, 40e6))
        self.assertEqual((other["bedding[0].mu"], other["bedding[0].spacing"]), (0.5, 0.002))
        self.assertEqual(recipe["matrix.E_c"], 38e9)

    def test_every_problem_is_told_in_the_words_of_the_program(self):
        wrong = dict(KEYS, matrix={"E_c": 38, "sigma_c": "-1 MPa", "colour": 3})
        with self.assertRaises(phyllite.InputError) as caught:
            phyllite.Recipe(**wrong)
        text = TEXT.replace('sigma_c = "40 MPa"\ntau_c = "40 MPa"', 'E_c = 38\nsigma_c = "-1 MPa"\ncolour = 3')
        _, told = program("recipe", write(self.at("wrong.toml"), text))
        lines = [line.split(": ", 1)[1] for line in told.splitlines()]
        self.assertEqual(len(lines), 3)
        self.assertEqual(sorted(str(caught.exception).splitlines()), sorted("Recipe: " + line for line in lines))
        self.assertEqual({p.key for p in caught.exception.problems}, {"matrix.E_c", "matrix.sigma_c", "matrix.colour"})
        self.assertIsInstance(caught.exception, ValueError)

    def test_what_no_file_could_hold_is_refused(self):
        for value in (object(), None, 1j, "two\nlines", b"bytes"):
            with self.assertRaises(phyllite.InputError):
                phyllite.Recipe(name=value)
        with self.assertRaisesRegex(phyllite.IoError, "no such file|cannot be read"):
            phyllite.Recipe.from_file(self.at("none.toml"))

    def test_explain_is_that_of_the_program(self):
        self.assertEqual(phyllite.explain("matrix.E_c"), program("recipe", "--explain", "matrix.E_c")[1])
        self.assertIn("E_is", phyllite.explain("E_is"))


class Rocks(InFolder):
    def rock_file(self):
        write(self.at("table.csv"), TABLE)
        write(self.at("model.toml"), TEXT.replace("angles", "# angles").replace("intact", "# intact"))
        return write(self.at("rock.toml"), 'name = "shale"\ndata = "table.csv"\nrecipe = "model.toml"\n')

    def test_check_is_that_of_the_program(self):
        path = self.rock_file()
        check, output = phyllite.Rock.from_toml(path).check(), program("rock", "check", path)[1]
        # the time is measured anew by each, and the program names its own option
        own = [line for line in check.splitlines() if "on this machine" not in line]
        of_program = [line for line in output.splitlines() if "on this machine" not in line and "Details: " not in line]
        self.assertEqual(own, of_program)

    def test_measured_rocks_are_named_and_read(self):
        self.assertIn("boryeong-shale", phyllite.rocks())
        rock = phyllite.rock("boryeong-shale")
        self.assertEqual((rock.name, len(rock.targets)), ("Boryeong shale", 7))
        with self.assertRaisesRegex(phyllite.InputError, "did you mean"):
            phyllite.rock("boryeong-shal")

    def test_table_frame_and_file_are_one_rock(self):
        path = self.rock_file()
        model = phyllite.Recipe.from_file(self.at("model.toml"))
        rocks = [phyllite.Rock.from_toml(path),
                 phyllite.Rock.from_csv(self.at("table.csv"), name="shale", recipe=model),
                 phyllite.Rock.from_csv(self.at("table.csv"), name="shale", recipe=self.at("model.toml"))]
        try:
            import pandas

            frame = pandas.read_csv(self.at("table.csv"))
            rocks.append(phyllite.Rock.from_dataframe(frame, name="shale", recipe=model))
        except ImportError:
            self.skipTest("pandas is missing")
        first = rocks[0]
        self.assertEqual(len(first.targets), 12)
        for rock in rocks:
            self.assertEqual(rock.name, "shale")
            of_each = [[line for line in r.check().split("\n")[1:] if "on this machine" not in line] for r in (rock, first)]
            self.assertEqual(*of_each)
        ucs = {t.theta: t.mean for t in first.targets if t.property == "UCS"}
        self.assertEqual(ucs, {0.0: 105e6, 30.0: 60e6, 60.0: 45e6, 90.0: 128e6})

    def test_findings_have_kinds_cells_and_numbers(self):
        write(self.at("units.csv"), "theta [deg],E [GPa],UCS [MPa]\n0,0.023,105\n45,20,60\n90,40,130\n")
        found = {f["kind"]: f for f in phyllite.Rock.from_csv(self.at("units.csv")).findings}
        self.assertEqual(found["unusual_value"]["cells"], [{"property": "E", "theta [deg]": 0.0}])
        self.assertAlmostEqual(found["unusual_value"]["numbers"]["value"], 0.023e9)
        self.assertEqual(found["unusual_value"]["advice"], "check_unit")
        self.assertIn("anisotropy", found)

    def test_targets_are_rows_of_a_frame(self):
        rock = phyllite.Rock.from_toml(self.rock_file())
        target = rock.targets[0]
        self.assertEqual((target.property, target.theta, target.mean, target.n), ("E", 0.0, 17.5e9, 3))
        with self.assertRaises(AttributeError):
            target.mean = 0.0
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is missing")
        table = phyllite.frame(rock.targets)
        self.assertEqual(list(table.columns), ["property", "theta", "mean", "sd", "n", "confining", "diameter", "unit"])
        self.assertEqual(len(table), 12)
        self.assertEqual(table[table["property"] == "UCS"]["mean"].tolist(), [105e6, 60e6, 45e6, 128e6])

    def test_a_rock_is_made_of_a_table(self):
        for wrong in (TABLE, {"theta": [0]}):
            with self.assertRaisesRegex(TypeError, "expected a pandas DataFrame"):
                phyllite.Rock.from_dataframe(wrong)
        with self.assertRaisesRegex(TypeError, "Rock.from_csv"):
            phyllite.Rock("shale.csv")

    def test_a_workbook_is_a_table(self):
        path = os.path.join(os.environ["PHY_SOURCE_DIR"], "tests/fuzz/seeds/workbook/openpyxl.xlsx")
        rock = phyllite.Rock.from_csv(path, sheet="Results", columns={"σt": "DTS"})
        tension = {t.theta: t.mean for t in rock.targets if t.property == "DTS"}
        self.assertEqual(tension, {0.0: 4.6e6, 60.0: 7.55e6, 90.0: 9.1e6})
        self.assertIn("sheets is read: Results", phyllite.Rock.from_csv(path).check())

    def test_what_is_wrong_with_a_table_is_told_by_line(self):
        path = write(self.at("bad.csv"), TABLE.replace("60,21.0", "60,soft"))
        with self.assertRaisesRegex(phyllite.InputError, r"bad\.csv:4"):
            phyllite.Rock.from_csv(path)
        with self.assertRaisesRegex(phyllite.InputError, "colour"):
            phyllite.Rock.from_csv(write(self.at("good.csv"), TABLE), colour="grey")
        with self.assertRaisesRegex(phyllite.InputError, "lost.csv"):
            phyllite.Rock.from_csv(self.at("lost.csv"))
        with self.assertRaisesRegex(phyllite.IoError, "lost.toml"):
            phyllite.Rock.from_toml(self.at("lost.toml"))

    def test_examples_are_read(self):
        rock = phyllite.Rock.from_toml(SOURCE / "examples/twin/twin.toml")
        self.assertEqual(rock.name, "twin of the paper's specimen")
        self.assertEqual(sum(t.n for t in rock.targets if t.property == "UCS"), 21)
        self.assertEqual(phyllite.Recipe(**SPECIMEN)["specimen.width"], 0.008)
