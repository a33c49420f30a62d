"""Calibrations: the files of the program, its verdict, and its way to go on after Ctrl-C."""
import inspect
import json
import pathlib
import pickle
import threading

import phyllite
from small import LEAST, TABLE, has, program, write
from test_recipes import InFolder
from test_runs import interrupt

MODEL = '[specimen]\nwidth = "7 mm"\nheight = "14 mm"\n[packing]\nn_grains = 253\n[[bedding]]\nspacing = "2 mm"\n'


class Calibrations(InFolder):
    def rock(self):
        write(self.at("start.toml"), MODEL)
        write(self.at("table.csv"), TABLE)
        return write(self.at("rock.toml"), 'data = "table.csv"\nrecipe = "start.toml"\n')

    def read(self, *names):
        return pathlib.Path(self.folder.name, *names).read_text()

    def test_elastic_files_are_those_of_the_program(self):
        path = self.rock()
        found = phyllite.calibrate(phyllite.Rock.from_toml(path), self.at("mine"), elastic=True)
        code, text = program("calibrate", path, "--elastic", "--out", self.at("its"))
        self.assertIn(code, (0, 1), text)
        for name in ("calibrated.toml", "calibration.json", "request.toml", "calibrated.p2dat",
                     "calibrated-yade.py", "ensemble/07.toml", "tables.txt", "report.html"):
            mine, its = self.read("mine", name), self.read("its", name)
            mine = mine.replace('["results","mine"]', '["results","its"]')  # the report names its folder
            self.assertEqual([l for l in mine.splitlines() if " s, " not in l],
                             [l for l in its.splitlines() if " s, " not in l], name)
        self.assertEqual(found.to_dict(), json.loads(self.read("its", "calibration.json")))
        self.assertEqual(found.recipe, phyllite.Recipe.from_file(self.at("its/calibrated.toml")))
        self.assertEqual([found.ensemble[6]], [phyllite.Recipe.from_file(self.at("its/ensemble/07.toml"))])
        keys = {p.key: p for p in found.parameters}
        modulus = keys["matrix.E_c"]
        self.assertTrue(modulus.determined and modulus.low < modulus.value < modulus.high)
        self.assertEqual(found.recipe["matrix.E_c"], modulus.value)
        self.assertIn(found.verdict.sentence, " ".join(text.split()))
        for row in found.table:
            self.assertAlmostEqual(row.error, row.model / row.laboratory - 1)
        loaded = phyllite.load(self.at("its"))
        self.assertEqual((loaded.to_dict(), loaded.recipe, loaded.ensemble), (found.to_dict(), found.recipe, found.ensemble))
        self.assertEqual([str(p) for p in loaded.parameters], [str(p) for p in found.parameters])
        self.assertEqual(str(loaded.verdict), str(found.verdict))
        self.assertEqual(pickle.loads(pickle.dumps(loaded)).to_dict(), found.to_dict())
        self.assertIn(found.verdict.lines[0].split(":")[0], loaded._repr_html_())
        if has("matplotlib") and has("pandas"):
            self.shows_its_table(found, loaded)
        loaded.save(self.at("copied"))
        self.assertEqual(self.read("copied", "calibration.json"), self.read("its", "calibration.json"))
        found.save(self.at("saved"))
        self.assertEqual(self.read("saved", "calibrated.toml"), self.read("its", "calibrated.toml"))
        self.assertIn("<html", self.read("saved", "report.html"))

    def shows_its_table(self, found, loaded):
        means = [row.laboratory * 1e-9 for row in found.table if row.property == "E"]
        shown = {round(float(y), 3) for line in loaded.plot().axes[0].get_lines() for y in line.get_ydata()}
        self.assertLessEqual({round(mean, 3) for mean in means}, shown)
        in_lab_units = phyllite.frame(found.table, units="lab")
        self.assertEqual(list(in_lab_units["unit"])[0], "GPa")
        self.assertAlmostEqual(in_lab_units["laboratory"][0], 17.5)

    def test_interrupted_and_resumed_it_ends_with_the_identical_result(self):
        rock = phyllite.Rock.from_csv(write(self.at("table.csv"), TABLE), name="rock",
                                      recipe=phyllite.Recipe(**LEAST, bedding=[{"spacing": "2 mm"}]))
        whole = phyllite.calibrate(rock, max_tests=72)
        begun = threading.Event()
        thread = interrupt(begun)
        with self.assertRaises(KeyboardInterrupt):
            phyllite.calibrate(rock, self.at("parts"), max_tests=72,
                               progress=lambda p: begun.set() if p.n_done > 2 else None)
        thread.join()
        self.assertFalse(pathlib.Path(self.at("parts"), "calibration.json").exists())
        with self.assertRaisesRegex(phyllite.InputError, "resume=True goes on with it; another out begins"):
            phyllite.calibrate(rock, self.at("parts"), max_tests=72)
        with self.assertRaisesRegex(phyllite.InputError, "max_tests = 80: expected 72"):
            phyllite.calibrate(rock, self.at("parts"), max_tests=80, resume=True)
        resumed = phyllite.calibrate(rock, self.at("parts"), max_tests=72, resume=True)
        self.assertEqual(resumed.to_dict(), whole.to_dict())
        self.assertEqual(len(whole.ensemble), 20)
        self.assertEqual({row.property for row in whole.table}, {"E", "nu", "UCS"})
        missed, beyond = whole.missed("UCS", 40), whole.missed("sigma_1", 40, 20e6)
        self.assertEqual(len(missed.of_draws), 20)
        self.assertAlmostEqual(missed.factor, beyond.factor)
        self.assertGreater(beyond.sd, missed.sd)
        self.assertIsNone(whole.missed("BTS"))
        with self.assertRaisesRegex(ValueError, "strength: no property"):
            whole.missed("strength")
        self.assertIn(whole.verdict.status, str(whole).splitlines()[0] + whole.verdict.status)

    def test_every_option_of_the_program_is_an_argument(self):
        parameters = inspect.signature(phyllite.calibrate).parameters
        _, usage = program("calibrate", "--help")
        for name, default, allowed, meaning in phyllite._core.calibration_options():
            self.assertIn("--" + name.replace("_", "-"), usage)
            if name == "out":  # without it nothing is kept
                self.assertIsNone(parameters[name].default)
                continue
            self.assertEqual(parameters[name].default, default, name)
            self.assertIn(f"{name}: {meaning} ({allowed})", phyllite.calibrate.__doc__)
        with self.assertRaisesRegex(TypeError, "efort"):
            phyllite.calibrate(self.rock(), efort="quick")

    def test_what_cannot_be_is_told(self):
        rock = phyllite.Rock.from_toml(self.rock())
        with self.assertRaisesRegex(phyllite.InputError, "^max_tests = 71: expected at least 72"):
            phyllite.calibrate(rock, max_tests=71)
        with self.assertRaisesRegex(phyllite.InputError, "^max_tests = 71"):
            phyllite.calibrate(self.at("rock.toml"), max_tests=71)  # the rock by its file
        for wrong in (3, None, phyllite.Recipe(**LEAST)):
            with self.assertRaisesRegex(TypeError, "Rock.from_dataframe"):
                phyllite.calibrate(wrong)
        with self.assertRaisesRegex(phyllite.InputError, 'method = "guess": expected one of "posterior" "sequence"'):
            phyllite.calibrate(rock, method="guess")
        with self.assertRaisesRegex(phyllite.InputError, 'one of "auto" "quick" "normal" "thorough"'):
            phyllite.calibrate(rock, effort="hasty")
        with self.assertRaisesRegex(phyllite.InputError, 'none beside method="sequence"'):
            phyllite.calibrate(rock, method="sequence", effort="quick")
