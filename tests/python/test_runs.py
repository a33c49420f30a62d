"""Tests under the press: the same bits as the program, arrays without copies, Ctrl-C, the free interpreter lock."""
import copy
import csv
import gc
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import threading
import time
import unittest
from concurrent import futures

import numpy as np

import phyllite
from small import KEYS, TABLE, TEXT, has, program, write
from test_recipes import InFolder


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def interrupt(event):
    """Sends Ctrl-C to this process once `event` has come."""
    def wait():
        event.wait(60)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=wait)
    thread.start()
    return thread


class Runs(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.recipe = phyllite.Recipe(**KEYS)
        cls.news = []
        cls.result = phyllite.run(cls.recipe, threads=2, progress=cls.news.append)

    def test_numbers_series_and_hashes_are_those_of_the_program(self):
        code, text = program("run", write(self.at("small.toml"), TEXT), "--out", self.at("out"))
        self.assertIn(code, (0, 1), text)
        self.assertEqual([s.name for s in self.result], ["theta = 45 deg", "theta = 60 deg", "intact"])
        for specimen, folder in zip(self.result, ("theta_45_deg", "theta_60_deg", "intact")):
            folder = pathlib.Path(self.at("out")) / folder
            told = json.loads((folder / "result.json").read_text())
            self.assertEqual(specimen.hash, told["result_hash"])
            self.assertEqual((specimen.status, specimen.reason), (told["outcome"]["status"], told["outcome"]["reason"]))
            self.assertEqual(set(specimen.numbers), set(told["numbers"]))
            for name, number in told["numbers"].items():
                mine = specimen.numbers[name]
                self.assertEqual((mine.unit, mine.definition), (number["unit"], number["definition"]))
                self.assertTrue(float(mine) == number["value"] or number["value"] is None and np.isnan(mine.value), name)
            history = rows_of(folder / "history.csv")
            self.assertEqual(len(history), len(specimen.history))
            for name, unit, _ in specimen.columns:
                np.testing.assert_array_equal(specimen.history[name],
                                              [float(row[f"{name} [{unit}]"]) for row in history])
            cracks = rows_of(folder / "cracks.csv")
            self.assertEqual(len(cracks), len(specimen.cracks))
            self.assertGreater(len(cracks), 0)
            np.testing.assert_array_equal(specimen.cracks["grain_a"], [int(row["grain_a"]) for row in cracks])
            np.testing.assert_array_equal(specimen.cracks["x"], [float(row["x [m]"]) for row in cracks])

    def test_result_is_a_table_by_number(self):
        self.assertEqual(len(self.result), 3)
        np.testing.assert_array_equal(self.result.theta, [45.0, 60.0, np.nan])
        ucs = self.result.values("ucs")
        self.assertEqual(ucs[0], self.result["theta = 45 deg"].numbers["ucs"].value)
        self.assertGreater(ucs[2], ucs[1])
        with self.assertRaisesRegex(KeyError, "no number is called 'no_such_number'; there are ucs, .* more"):
            self.result.values("no_such_number")
        with self.assertRaisesRegex(KeyError, "no specimen is called 'nobody'; there are theta = 45 deg"):
            self.result["nobody"]
        self.assertTrue(any("theta = 45 deg" in str(n) for n in self.news))
        self.assertEqual(max(n.n_total for n in self.news), 3)

    def test_arrays_are_the_memory_of_the_result(self):
        specimen = self.result[0]
        for name in ("history", "cracks", "discs", "grains", "contacts"):
            array = getattr(specimen, name)
            self.assertTrue(np.shares_memory(array, getattr(specimen, name)), name)
            self.assertFalse(array.flags.owndata or array.flags.writeable, name)
            with self.assertRaises(ValueError):
                array[array.dtype.names[0]] = 0
        self.assertEqual(len(specimen.discs), 330)
        self.assertEqual(len(specimen.grains), 330)
        touching = specimen.contacts[~specimen.contacts["broken"] & (specimen.contacts["kind"] == 1)]
        distance = np.hypot(*(specimen.discs[c][touching["grain_a"]] - specimen.discs[c][touching["grain_b"]]
                              for c in "xy"))
        radii = specimen.discs["r"][touching["grain_a"]] + specimen.discs["r"][touching["grain_b"]]
        self.assertGreater(len(touching), 100)
        self.assertLess(np.max(np.abs(distance / radii - 1)), 0.25)  # they are neighbours: fields are where they lie

    def test_arrays_outlive_the_result(self):
        result = phyllite.run(self.recipe.changed(test={"angles": [], "intact": False}))
        history = result[0].history
        stress = history["axial_stress"].copy()
        del result
        gc.collect()
        np.zeros(1 << 22)
        np.testing.assert_array_equal(history["axial_stress"], stress)

    def test_frames(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is missing")
        table = phyllite.frame(self.result)
        self.assertEqual(list(table["specimen"]), [s.name for s in self.result])
        np.testing.assert_array_equal(table["ucs [Pa]"], self.result.values("ucs"))
        history = phyllite.frame(self.result[0].history)
        self.assertIsInstance(history, pandas.DataFrame)
        np.testing.assert_array_equal(history["axial_stress"], self.result[0].history["axial_stress"])

    def test_folder_is_that_of_the_program_and_guarded_like_it(self):
        out = self.at("out")
        phyllite.run(self.recipe, out)
        code, text = program("show", out)
        self.assertEqual(code, 0, text)
        self.assertTrue((pathlib.Path(out) / "report.html").exists())
        again = phyllite.run(self.recipe, out)
        self.assertEqual([s.hash for s in again], [s.hash for s in self.result])
        with self.assertRaisesRegex(phyllite.InputError, "results of another recipe.*use another out, or replace=True"):
            phyllite.run(self.recipe.changed(matrix={"E_c": "20 GPa"}), out)
        with self.assertRaises(phyllite.IoError):
            phyllite.run(self.recipe, "/dev/null/out")

    def test_a_recipe_may_be_named_by_its_file(self):
        path = pathlib.Path(write(self.at("small.toml"), self.recipe.to_toml()))
        for name in (path, str(path)):
            self.assertEqual([s.hash for s in phyllite.run(name)], [s.hash for s in self.result])
        self.assertEqual(phyllite.elastic(path).values("e")[0], phyllite.elastic(self.recipe).values("E")[0])
        for wrong in (3, None, {"matrix": {}}):
            for function in (phyllite.run, phyllite.elastic):
                with self.assertRaisesRegex(TypeError, function.__name__ + ": expected a Recipe, or the name"):
                    function(wrong)
        with self.assertRaisesRegex(TypeError, "study: expected the name of a study file"):
            phyllite.study(3, self.at("study"))

    def test_a_folder_is_the_result_again(self):
        made = phyllite.run(self.recipe, self.at("out"))
        back = phyllite.load(self.at("out"))
        self.assertEqual(back.recipe, made.recipe)
        for mine, its in zip(made, back):
            self.assertEqual((mine.name, mine.hash, mine.status), (its.name, its.hash, its.status))
            for array in ("history", "cracks", "discs"):
                np.testing.assert_array_equal(getattr(mine, array), getattr(its, array))
            self.assertEqual({n: v.value for n, v in mine.numbers.items() if v.value == v.value},
                             {n: v.value for n, v in its.numbers.items() if v.value == v.value})
        with self.assertRaisesRegex(phyllite.IoError, "no last state"):
            back[0].grains
        os.rename(self.at("out/intact"), self.at("intact"))
        with self.assertWarnsRegex(UserWarning, "intact: no result"):
            self.assertEqual(len(phyllite.load(self.at("out"))), 2)
        with self.assertRaisesRegex(phyllite.IoError, "nowhere"):
            phyllite.load(self.at("nowhere"))

    def test_results_travel_to_another_process(self):
        sent = pickle.loads(pickle.dumps(self.result))
        self.assertEqual(sent.recipe, self.result.recipe)
        for mine, its in zip(self.result, sent):
            self.assertEqual((mine.name, mine.hash, mine.reason, mine.numbers["ucs"].definition),
                             (its.name, its.hash, its.reason, its.numbers["ucs"].definition))
            for array in ("history", "cracks", "discs", "grains", "contacts"):
                np.testing.assert_array_equal(getattr(mine, array), getattr(its, array))
        rock = phyllite.Rock.from_csv(write(self.at("table.csv"), TABLE), recipe=self.recipe)
        self.assertEqual(copy.deepcopy(rock).targets, rock.targets)
        one = self.recipe.changed(test={"angles": ["45 deg"], "intact": False})
        with futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
            there = pool.submit(phyllite.run, one).result(timeout=300)
        self.assertEqual(there[0].hash, self.result[0].hash)

    @unittest.skipUnless(has("matplotlib"), "python3-matplotlib is missing")
    def test_charts_show_the_numbers_of_the_result(self):
        drawn = self.result.plot("stress_strain")
        highest = max(max(line.get_ydata()) for line in drawn.axes[0].get_lines() if len(line.get_ydata()) > 9)
        self.assertAlmostEqual(highest, max(s.history["axial_stress"].max() for s in self.result) * 1e-6, 4)
        over_angle = self.result.plot("anisotropy", rock=phyllite.Rock.from_csv(write(self.at("t.csv"), TABLE)))
        self.assertIn("laboratory", " ".join(t.get_text() for t in over_angle.legends[0].get_texts()))
        for kind in ("damage", "modes", "rose"):
            self.assertGreaterEqual(len(self.result.plot(kind).axes), 1)
        with self.assertRaisesRegex(phyllite.InputError, "^kind = strength: expected a chart of a run"):
            self.result.plot("strength")
        with self.assertRaisesRegex(phyllite.InputError, "^kind = UCS: .*did you mean anisotropy"):
            self.result[0].plot("UCS")

    @unittest.skipUnless(has("pandas"), "python3-pandas is missing")
    def test_laboratory_units_are_the_same_numbers(self):
        mine, its = phyllite.frame(self.result), phyllite.frame(self.result, units="lab")
        np.testing.assert_allclose(its["ucs [MPa]"] * 1e6, mine["ucs [Pa]"])
        np.testing.assert_allclose(its["E_tangent [GPa]"] * 1e9, mine["E_tangent [Pa]"])
        curve = phyllite.frame(self.result[0], units="lab")
        np.testing.assert_allclose(curve["axial_strain [%]"], 100 * self.result[0].history["axial_strain"])
        self.assertIn("<td>theta = 45 deg</td>", self.result._repr_html_())
        with self.assertRaisesRegex(ValueError, "laboratory|lab"):
            phyllite.frame(self.result, units="imperial")

    def test_names_are_found_whatever_their_capitals(self):
        np.testing.assert_array_equal(self.result.values("UCS"), self.result.values("ucs"))
        self.assertEqual(self.result["INTACT"].name, "intact")
        numbers = self.result[0].numbers
        self.assertEqual(numbers["E_TANGENT"].name, "E_tangent")
        self.assertNotIn("UCS", numbers)
        for ask in (self.result.values, numbers.__getitem__):
            with self.assertRaisesRegex(KeyError, "no number is called 'usc'; did you mean 'ucs'"):
                ask("usc")
        with self.assertRaisesRegex(KeyError, "no number is called '%%%'; there are .*ucs"):
            self.result.values("%%%")

    def test_what_the_recipe_cannot_do_is_an_input_error(self):
        discs = write(self.at("discs.csv"), "x [m],y [m],r [m]\n0.004,0.002,0.001\n0.004,0.014,0.001\n")
        apart = phyllite.Recipe(specimen=KEYS["specimen"], packing={"file": discs})  # no grain touches another
        with self.assertRaises(phyllite.InputError):
            phyllite.run(apart)

    def test_other_threads_go_on_meanwhile(self):
        count, stop = [0], threading.Event()

        def tick():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        phyllite.run(self.recipe)
        seconds, ticks = time.monotonic() - begin, count[0]
        stop.set()
        thread.join()
        self.assertGreater(ticks, 20 * seconds)  # a held lock would let none through

    def test_an_exception_of_progress_stops_the_run(self):
        def fail(_):
            raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            phyllite.run(self.recipe, self.at("out"), progress=fail)

    def test_ctrl_c_stops_a_run_and_leaves_no_empty_folder(self):
        slow = self.recipe.changed(test={"platen_speed": "0.001 m/s"})
        begun = threading.Event()
        thread = interrupt(begun)
        with self.assertRaises(KeyboardInterrupt):
            phyllite.run(slow, self.at("out"), progress=lambda _: begun.set())
        thread.join()
        self.assertFalse(os.path.exists(self.at("out")))


class Studies(InFolder):
    keys = dict(vary=[{"key": "bedding.k_n", "times": [0.5, 1, 2]}], packings=[1, 2])

    def recipe(self):
        return phyllite.Recipe(**KEYS)

    def test_hash_and_tables_are_those_of_the_program(self):
        found = phyllite.study(self.recipe(), self.at("mine"), **self.keys)
        write(self.at("base.toml"), TEXT)
        path = write(self.at("study.toml"), 'recipe = "base.toml"\npackings = [1, 2]\n[[vary]]\n'
                                            'key = "bedding.k_n"\ntimes = [0.5, 1, 2]\n')
        code, text = program("study", path, "--out", self.at("its"))
        self.assertIn(code, (0, 1), text)
        self.assertIn("hash " + found.hash, text)
        self.assertEqual(str(found), found.text)
        self.assertIn(f"{len(found.table)} specimens", repr(found))
        for name in ("effects.csv", "responses.csv"):
            self.assertEqual(*(pathlib.Path(self.at(f), name).read_text() for f in ("mine", "its")))
        mine, its = rows_of(self.at("mine/results.csv")), rows_of(self.at("its/results.csv"))
        for row in mine + its:
            del row["cpu [s]"]
        self.assertEqual(mine, its)
        self.assertEqual(len(found.table), 18)
        self.assertEqual({row["bedding.k_n [Pa/m]"] for row in found.table}, {1680e9, 3360e9, 6720e9})
        self.assertEqual(phyllite.study(path, self.at("again")).hash, found.hash)
        back = phyllite.load(self.at("its"))
        self.assertEqual((back.hash, back.text, len(back.table)), (found.hash, found.text, len(found.table)))
        if has("matplotlib"):
            self.assertGreaterEqual(len(back.plot("modulus").axes), 1)

    def test_ctrl_c_keeps_what_is_finished_and_the_same_call_goes_on(self):
        # One packing after the other: the last are far from done when the first is, also where news comes late.
        keys = dict(self.keys, packings=list(range(1, 16)))
        whole = phyllite.study(self.recipe(), self.at("whole"), **keys)
        with self.assertRaises(KeyboardInterrupt):
            phyllite.study(self.recipe(), self.at("parts"), threads=1, **keys,
                           progress=lambda p: p.n_done > 0 and os.kill(os.getpid(), signal.SIGINT))
        left = program("study", "status", self.at("parts"))[1]
        self.assertRegex(left, r"status +[1-9]\d* of 105 finished")
        self.assertNotIn("105 of 105", left)
        self.assertEqual(phyllite.study(self.recipe(), self.at("parts"), **keys).hash, whole.hash)

    def test_problems_are_those_of_a_study(self):
        with self.assertRaisesRegex(phyllite.InputError, "did you mean"):
            phyllite.study(self.recipe(), self.at("out"), vary=[{"key": "bedding.kn", "times": [1]}])
        with self.assertRaises(TypeError):
            phyllite.study(self.at("study.toml"), self.at("out"), packings=[1])
        self.assertFalse(os.path.exists(self.at("out")))


class Directly(InFolder):
    def test_elastic_answers_are_those_of_the_program(self):
        found = phyllite.elastic(phyllite.Recipe(**dict(KEYS, test={"angles": [f"{a} deg" for a in range(0, 91, 30)]})))
        path = write(self.at("small.toml"), TEXT.replace('["45 deg", "60 deg"]', '["0 deg", "30 deg", "60 deg", "90 deg"]'))
        code, text = program("elastic", path)
        self.assertEqual(code, 0, text)
        for row in found.specimens:
            line = next(line for line in text.splitlines() if line.startswith(row["name"] + " "))
            self.assertEqual(line[len(row["name"]):].split()[:2], [f"{row['E'] * 1e-9:.3f}", f"{row['nu']:.4f}"])
        np.testing.assert_array_equal(found.theta, [0, 30, 60, 90, np.nan])
        self.assertEqual(len(found.joints), 6)
        fit = next(f for f in found.joints if f["name"] == "pushing, free")
        self.assertRegex(text, r"pushing, free +%.2f +%.1f" % (fit["E"] * 1e-9, fit["K_n"] * 1e-9))
        slope = {s["parameter"]: s["dE"] for s in found.sensitivities if s["name"] == "intact"}
        self.assertGreater(slope["matrix.E_c"], 0)

    def test_a_contact_follows_the_closed_form(self):
        for law in phyllite.contact_laws():
            rows = phyllite.contact(law.name, steps=200)
            scale = np.max(np.abs(rows["F_n_exact"]))
            self.assertLess(np.max(np.abs(rows["F_n"] - rows["F_n_exact"])), 0.02 * scale, law.name)

    def test_a_contact_is_that_of_the_program(self):
        path = [(1e-6, 0.0), (1e-6, 8e-6, 0.0), "-5 um, 8 um, 0.1 deg"]
        rows = phyllite.contact("smooth_joint", path, steps=7, mu=0.5)
        code, text = program("contact", "smooth_joint", "--set", "mu=0.5", "--steps", "7", "--to", "1 um, 0 um", "--to",
                             "1 um, 8 um, 0 deg", "--to=-5 um, 8 um, 0.1 deg", "--out", self.at("path.csv"))
        self.assertEqual(code, 0, text)
        its = rows_of(self.at("path.csv"))
        self.assertEqual(len(its), len(rows))
        for mine, head in (("F_n", "F_n [N/m]"), ("F_s", "F_s [N/m]"), ("F_s_exact", "F_s exact [N/m]")):
            np.testing.assert_array_equal(rows[mine], [float(row[head]) for row in its])

    def test_what_is_wrong_with_a_contact_is_told(self):
        with self.assertRaisesRegex(phyllite.InputError, "^law = smoth_joint: expected one of .*smooth_joint"):
            phyllite.contact("smoth_joint")
        with self.assertRaisesRegex(phyllite.InputError, '^k_n = 38000000000.0: .*for example k_n=".* N/m"'):
            phyllite.contact("linear", k_n=38e9)
        with self.assertRaisesRegex(phyllite.InputError, "^kn = 3: expected a parameter of the law: k_n, "):
            phyllite.contact("linear", kn=3)
        with self.assertRaisesRegex(phyllite.InputError, r'^path = 1 um: .*for example path=\["1 um, 8 um, 0 deg"\]'):
            phyllite.contact("linear", ["1 um"])
        with self.assertRaisesRegex(phyllite.InputError, "^key = matrix.E_d: .*did you mean"):
            phyllite.explain("matrix.E_d")
        with self.assertRaisesRegex(phyllite.InputError, "two or three finite numbers"):
            phyllite.contact("linear", [(1e-6, float("nan"))])
