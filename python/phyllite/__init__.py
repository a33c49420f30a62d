"""Phyllite: a laboratory for layered rock.

    import phyllite
    recipe = phyllite.Recipe(bedding=[{}], test={"angles": [f"{a} deg" for a in range(0, 91, 15)]})
    result = phyllite.run(recipe, progress=print)
    for specimen in result:
        print(specimen.theta, specimen.numbers["ucs"])

These lines break the paper's specimen at seven inclinations of its bedding. SI units and degrees; compression and
shortening positive; theta is the inclination of the bedding planes, the load being vertical (docs/conventions.md).

Functions that take long release the interpreter lock, end soon on Ctrl-C (KeyboardInterrupt) and call
`progress`, if given, with a Progress now and then; progress="bar" shows a bar. threads=0 means all cores.
"""
import csv as _csv
import glob as _glob
import inspect as _inspect
import io as _io
import json as _json
import os as _os
import shutil as _shutil
import sys as _sys
import warnings as _warnings
from collections.abc import Sequence as _Sequence
from dataclasses import asdict as _asdict
from dataclasses import dataclass
from dataclasses import field as _field
from dataclasses import is_dataclass as _is_dataclass
from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Tuple, Union

import numpy as _np

from . import _core
from . import drawing as _drawing
from . import notebook as _notebook
from ._core import Number, Recipe, Specimen, __version__, theory
from .errors import Error, InputError, InternalError, IoError, Problem
from .names import known as _known_name

_sys.modules[__name__ + ".theory"] = theory

Path = Union[str, "_os.PathLike[str]"]

__all__ = ["Calibration", "Comparison", "ContactLaw", "Elastic", "Error", "Finding", "InputError", "InternalError",
           "IoError", "LawParameter", "Missed", "Number", "Parameter", "Problem", "Progress", "Recipe", "Result", "Rock", "Specimen",
           "Study", "Target", "Verdict", "calibrate", "contact", "contact_laws", "elastic", "explain", "frame", "load", "rock",
           "rocks", "run", "study", "theory", "__version__"]


def __dir__() -> List[str]:
    """The public names, not what they are made with: what a notebook offers behind `phyllite.`"""
    return sorted(__all__)


@dataclass(frozen=True)
class Progress:
    """How far a job has come; str() of it is one line."""

    text: str
    n_done: int  #: tests finished; 0 where the line is about something else
    n_total: int

    def __str__(self) -> str:
        return self.text


ProgressFunction = Union[None, str, Callable[[Progress], Any]]


def _reporter(progress: ProgressFunction) -> Optional[Callable[[str, int, int], Any]]:
    if progress is None:
        return None
    if progress == "bar":
        return _notebook.Bar()
    if not callable(progress):
        raise TypeError(f'progress: expected a function of a Progress, "bar" or None; got {progress!r}')
    return lambda text, done, total: progress(Progress(text, done, total))


def _text(path: Optional[Path]) -> str:
    return "" if path is None else _os.fspath(path)


class _Default:
    """Stands in signatures for the default of a key, which explain() states."""

    def __repr__(self) -> str:
        return "..."


def _with_keys(function: Any, of: str) -> Any:
    """Names the keys of a file in the signature: completion and help() show them."""
    fixed = [p for p in _inspect.signature(function).parameters.values() if p.kind is not p.VAR_KEYWORD]
    taken = {p.name for p in fixed} | {"data"}  # which is the table that is given
    keys = [_inspect.Parameter(key, _inspect.Parameter.KEYWORD_ONLY, default=_Default())
            for key in _core.keys()[of] if key.isidentifier() and key not in taken]
    function.__signature__ = _inspect.Signature(fixed + keys)
    return function


Recipe.__signature__ = _with_keys(lambda **keys: None, "recipe").__signature__  # type: ignore[attr-defined]


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, _os.PathLike))


def _recipe(value: Any, function: str) -> Recipe:
    """A recipe, or the name of its file."""
    if isinstance(value, _core.Recipe):
        return value
    if _is_path(value):
        return _core.Recipe.from_file(value)
    raise TypeError(f"{function}: expected a Recipe, or the name of a recipe file (TOML); got {type(value).__name__}")


def _in_lab_units(name: str, unit: str) -> Tuple[float, str]:
    """From SI: factor and unit that laboratories write. Moduli in GPa, stresses in MPa, strains in percent."""
    if unit in ("Pa", "Pa/m"):
        big = unit == "Pa/m" or name.split(".")[-1][:1] in ("E", "G")
        return (1e-9, "G" + unit) if big else (1e-6, "M" + unit)
    if unit.startswith("Pa "):
        return 1e-6, "M" + unit
    if unit == "m":
        return 1e3, "mm"
    return (100.0, "%") if unit == "1" and "strain" in name else (1.0, unit)


def _scaled(row: Dict[str, Any], names: Iterable[str], of: str, unit: str) -> Dict[str, Any]:
    factor, new = _in_lab_units(of, unit)
    return {**row, **{name: factor * row[name] for name in names}, "unit": new}


def _rows_in_lab_units(rows: List[Any]) -> List[Any]:
    """Rows of one table: parameters, comparisons or targets, or columns with their unit in the head."""
    def one(row: Any) -> Dict[str, Any]:
        cells = _asdict(row) if _is_dataclass(row) else row
        if isinstance(row, Parameter):
            return _scaled(cells, ("value", "low", "high"), row.key, row.unit)
        if isinstance(row, (Comparison, Target)):
            values = ("mean", "sd") if isinstance(row, Target) else (
                "laboratory", "laboratory_sd", "model", "model_sd", "with_discrepancy", "low", "high")
            cells = _scaled(cells, values, row.property, row.unit)
            return {**cells, "confining": 1e-6 * row.confining, "diameter": 1e3 * row.diameter}
        renamed = {}
        for head, value in cells.items():
            name, bracket, unit = head.partition(" [")
            factor, new = _in_lab_units(name, unit.rstrip("]")) if bracket else (1.0, "")
            renamed[f"{name} [{new}]" if bracket else head] = value if factor == 1.0 else factor * value
        return renamed

    return [one(row) for row in rows]


def frame(rows: Any, units: str = "SI") -> Any:
    """A pandas DataFrame of a result: Result, Specimen (its history), list of parameters or comparisons, cracks ...

    units: "SI", or "lab": moduli in GPa, stresses in MPa, strains in percent, lengths in mm.
    """
    import pandas

    if units not in ("SI", "lab"):
        raise ValueError(f'units: expected "SI" or "lab"; got {units!r}')
    if isinstance(rows, Specimen):
        history = rows.history
        rows = pandas.DataFrame({f"{name} [{unit}]": history[name] for name, unit, _ in rows.columns})
        return pandas.DataFrame(_rows_in_lab_units([dict(rows)])[0]) if units == "lab" else rows
    if hasattr(rows, "_frame_rows"):
        rows = rows._frame_rows()
    if isinstance(rows, _np.ndarray):
        if units == "lab":
            raise ValueError('units: an array does not know its units; frame(specimen, units="lab") has those of its history')
        return pandas.DataFrame(rows)
    rows = list(rows)
    if units == "lab":
        return pandas.DataFrame(_rows_in_lab_units(rows))
    return pandas.DataFrame([_asdict(row) if _is_dataclass(row) else row for row in rows])


def explain(key: str) -> str:
    """Meaning, allowed values, default, units and name in PFC of a key of a recipe, rock or study."""
    return _core.explain(key)


# ---- the rock


@dataclass(frozen=True)
class Target:
    """A cell of a laboratory's table: one quantity at one inclination."""

    property: str  #: "E", "nu", "UCS", "DTS", "BTS", "sigma_1", "sigma_ci" or "K_Ic"
    theta: float  #: inclination of the bedding [deg]; load along y
    mean: float  #: of its specimens: E and strengths [Pa], nu [1], K_Ic [Pa sqrt(m)]
    sd: float  #: scatter of single specimens, in the unit of the mean
    n: int  #: specimens
    confining: float  #: confining stress [Pa]
    diameter: float  #: [m] of a disc or half disc; 0: the model's
    unit: str  #: of mean and sd


class Rock:
    """A rock as a laboratory saw it: a table of tests.

    Columns carry their unit: theta [deg], E [GPa], nu, UCS [MPa], DTS [MPa], BTS [MPa], K_Ic [MPa sqrt(m)], n ...
    (docs/formats.md, "Rock").
    """

    def __init__(self, record: Any, made: Tuple[str, Tuple[Any, ...]] = ("", ())):
        if not isinstance(record, _core.RockRecord):
            raise TypeError("a Rock comes from Rock.from_toml, Rock.from_csv or Rock.from_dataframe")
        self._record = record
        self._made = made  # a copy, also in another process, is made the same way: files are read there again

    @staticmethod
    def _make(how: str, *arguments: Any) -> "Rock":
        copies = [dict(a) if isinstance(a, dict) else a for a in arguments]  # whose keys are completed there
        return Rock(getattr(_core.RockRecord, how)(*copies), (how, arguments))

    def __reduce__(self) -> Any:
        return Rock._make, (self._made[0], *self._made[1])

    @staticmethod
    def from_toml(path: Path) -> "Rock":
        """The rock of a rock file. Raises IoError, or InputError with every problem of all its files."""
        return Rock._make("from_toml", _text(path))

    @staticmethod
    def from_csv(path: Path, **keys: Any) -> "Rock":
        """The rock of a table, with keys of a rock file: Rock.from_csv("shale.csv", E_is="secant 50 %").

        Workbooks are tables too: Rock.from_csv("shale.xlsx", sheet="UCS", columns={"peak stress": "UCS"}). recipe may
        be a Recipe or the name of a file. Raises IoError, or InputError with every problem found.
        """
        stem = _os.path.splitext(_os.path.basename(_text(path)))[0]
        return Rock._make("from_keys", {"name": stem, **keys, "data": _text(path)}, "Rock.from_csv", None)

    @staticmethod
    def from_dataframe(frame: Any, **keys: Any) -> "Rock":
        """The rock of a pandas DataFrame with the columns of a table; keys as of from_csv.

        Its index is passed over. Lines in messages count from the names of the columns: the first row is line 2.
        """
        if not hasattr(frame, "to_csv"):
            raise TypeError(f"Rock.from_dataframe: expected a pandas DataFrame; got {type(frame).__name__}")
        return Rock._make("from_keys", {"name": "rock", **keys, "data": "DataFrame"}, "Rock.from_dataframe",
                          frame.to_csv(index=False))

    @property
    def name(self) -> str:
        """Its name."""
        return self._record.name

    @property
    def notes(self) -> List[str]:
        """How the table was understood, a line each."""
        return self._record.notes

    @property
    def findings(self) -> List[Dict[str, Any]]:
        """What the table says by itself, as data: kind, cells, numbers, names, advice, and a text for people.

        Doubts first (units, angles, outliers), then closed forms, then what the table lacks.
        """
        return _json.loads(self._record.findings)

    @property
    def targets(self) -> List[Target]:
        """The table as a calibration reads it: a Target per quantity and inclination."""
        return [Target(**row) for row in self._record.targets]

    def check(self, all: bool = False) -> str:
        """What its data can and cannot determine, before anything runs, as `phyllite rock check` prints it.
        `all`: with every detail."""
        return self._record.check(all)

    def __repr__(self) -> str:
        return f"<phyllite.Rock \"{self.name}\">"

    def _repr_html_(self) -> str:
        head = ["property", "unit", "theta [deg]", "mean", "scatter", "n", "confining [MPa]"]
        rows = _rows_in_lab_units(self.targets)
        cells = [[r["property"], r["unit"], r["theta"], r["mean"], r["sd"], r["n"], r["confining"]] for r in rows]
        return _notebook.paragraphs([self.name]) + _notebook.table(head, cells)


_with_keys(Rock.from_csv, "rock")
_with_keys(Rock.from_dataframe, "rock")


def _rock(value: Any, function: str) -> Rock:
    """A rock, or the name of its file."""
    if isinstance(value, Rock):
        return value
    if _is_path(value):
        return Rock.from_toml(value)
    raise TypeError(f"{function}: expected a Rock, or the name of a rock file (TOML); got {type(value).__name__}. "
                    "Rock.from_csv and Rock.from_dataframe make a Rock of a table")


def rocks() -> List[str]:
    """Names of the measured rocks that come with the program (docs/rocks.md)."""
    return list(_core.rocks())


def rock(name: str) -> Rock:
    """One of them: phyllite.rock("boryeong-shale"). Raises InputError for another name."""
    return Rock._make("from_base", name)


# ---- tests


class Result(_Sequence):
    """The specimens of a run in the order of its angles, intact rock last."""

    def __init__(self, recipe: Recipe, specimens: List[Specimen], folder: str):
        self.recipe = recipe
        self.folder = folder  #: where the program's files are; "": nowhere
        self._specimens = specimens

    def __len__(self) -> int:
        return len(self._specimens)

    def __getitem__(self, index: Any) -> Any:
        """A specimen by its place or its name."""
        if isinstance(index, str):
            names = [s.name for s in self._specimens]
            return self._specimens[names.index(_known_name(index, names, "specimen"))]
        return self._specimens[index]

    def __iter__(self) -> Iterator[Specimen]:
        return iter(self._specimens)

    @property
    def theta(self) -> _np.ndarray:
        """Inclinations of the bedding [deg], NaN of intact rock."""
        return _np.array([s.theta for s in self])

    def values(self, number: str) -> _np.ndarray:
        """One number of all specimens, SI: values("ucs"). NaN where a specimen has none; KeyError where all have none."""
        each = [s.numbers for s in self]
        name = _known_name(number, dict.fromkeys(n for numbers in each for n in numbers), "number") if each else number
        return _np.array([float(numbers[name]) if name in numbers else _np.nan for numbers in each])

    def _frame_rows(self) -> List[Dict[str, Any]]:
        head = [{"specimen": s.name, "theta [deg]": s.theta, "status": s.status} for s in self]
        return [{**h, **{f"{n.name} [{n.unit}]": n.value for n in s.numbers.values()}} for h, s in zip(head, self)]

    def plot(self, kind: str = "stress_strain", *, rock: Optional[Rock] = None, ax: Any = None) -> Any:
        """A Matplotlib figure: "stress_strain", "damage", "anisotropy" (over the angle), "modes" or "rose" of the cracks.

        rock: its values stand beside "anisotropy". ax: axes to draw into, where the figure has one panel.
        """
        return _drawing.draw(_core.run_figure(self._specimens, kind, None if rock is None else rock._record), ax)

    def __repr__(self) -> str:
        return f"<phyllite.Result of {len(self)} specimens>"

    def _repr_html_(self) -> str:
        rows = _rows_in_lab_units(self._frame_rows())
        known = [name for name in (rows[0] if rows else {}) if any(row.get(name) == row.get(name) for row in rows)]
        shown = known[:12]
        return _notebook.table(shown, [[row.get(name) for name in shown] for row in rows]) + _notebook.paragraphs(
            [f"{len(known) - len(shown)} more numbers: phyllite.frame(result)"] if len(known) > len(shown) else [])


def run(recipe: Union[Recipe, Path], out: Optional[Path] = None, *, replace: bool = False, threads: int = 0,
        progress: ProgressFunction = None) -> Result:
    """Runs the laboratory test of a recipe on all its specimens.

    recipe: a Recipe, or the name of its file.
    out: a folder that is filled as `phyllite run` fills it. Finished specimens are kept there after Ctrl-C.
    replace: results of another recipe are removed from it.
    Numbers and hashes are the program's, whatever the number of threads. Raises InputError, IoError.
    """
    recipe = _recipe(recipe, "run")
    tests = _core.run(recipe, _text(out), replace, threads, _reporter(progress))
    return Result(recipe, tests, _text(out))


def _plot_specimen(self: Specimen, kind: str = "stress_strain", *, ax: Any = None) -> Any:
    """plot(kind="stress_strain", *, ax=None): as Result.plot, of this specimen alone."""
    return _drawing.draw(_core.run_figure([self], kind, None), ax)


Specimen.plot = _plot_specimen  # type: ignore[method-assign]
Recipe._repr_html_ = lambda self: _notebook.paragraphs([f"Recipe {self.name}: {', '.join(self.specimens)}"]) + (  # type: ignore[attr-defined]
    _notebook.folded("all keys", self.to_toml()))


@dataclass(frozen=True)
class Elastic:
    """E and nu at small strain by direct solution (docs/theory/statics.md). Lists of dicts; frame(...) of each."""

    #: Per specimen: name, theta [deg], E, nu, E_platen [Pa] with contacts that only push; E_pulling, nu_pulling with
    #: contacts that also pull; n_open of n_contacts; n_loose grains; solved, reason.
    specimens: List[Dict[str, Any]]
    #: Per specimen and parameter: value, unit, dE [Pa per unit], dnu [1 per unit].
    sensitivities: List[Dict[str, Any]]
    #: Eq. 1 through E(theta): E [Pa], K_n, K_s [Pa/m], K_n_delta, K_s_delta [Pa], R2; NaN and a reason without a fit.
    joints: List[Dict[str, Any]]

    @property
    def theta(self) -> _np.ndarray:
        """Inclinations [deg], NaN of intact rock."""
        return _np.array([s["theta"] for s in self.specimens])

    def values(self, name: str) -> _np.ndarray:
        """One column of the specimens: values("E")."""
        name = _known_name(name, self.specimens[0], "column") if self.specimens else name
        return _np.array([s[name] for s in self.specimens])


def elastic(recipe: Union[Recipe, Path], *, glued: bool = False, modulus_loss: bool = False, threads: int = 0,
            progress: ProgressFunction = None) -> Elastic:
    """Young's modulus, Poisson's ratio and macro joint stiffness without time steps, as `phyllite elastic`.

    glued: grains stick to the platens. modulus_loss: Eq. 1 is fitted in modulus instead of compliance.
    """
    return Elastic(*_core.elastic(_recipe(recipe, "elastic"), glued, modulus_loss, threads, _reporter(progress)))


# ---- studies


def _number_or_text(cell: str) -> Any:
    if cell == "":
        return _np.nan
    try:
        return float(cell)
    except ValueError:
        return cell


def _table(text: str) -> List[Dict[str, Any]]:
    rows = _csv.DictReader(_io.StringIO(text))
    return [{name: _number_or_text(cell) for name, cell in row.items()} for row in rows]


@dataclass(frozen=True)
class Study:
    """What a study has found; its folder holds the same as tables and a page."""

    folder: str
    table: List[Dict[str, Any]]  #: a row per specimen of the design, units in the names
    responses: List[Dict[str, Any]]  #: per response and point: mean, SD, 95 % interval over the replicates
    effects: List[Dict[str, Any]]  #: per response and parameter: slopes, R2, sensitivity indices
    text: str  #: the tables that the program prints
    hash: str  #: over all results, that of the program

    @staticmethod
    def _of(folder: str, found: Dict[str, str]) -> "Study":
        tables = {name: _table(found.get(name, "")) for name in ("table", "responses", "effects")}
        return Study(folder=folder, text=found.get("text", ""), hash=found.get("hash", ""), **tables)

    def plot(self, kind: str = "strength") -> Any:
        """A Matplotlib figure: "stiffness", "modulus" or "strength" over what was varied one at a time."""
        return _drawing.draw(_core.study_figure(self.folder, kind))

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<Study of {len(self.table)} specimens in {self.folder}, hash {self.hash}>"


def study(source: Union[Path, Recipe], out: Path, *, threads: int = 0, progress: ProgressFunction = None,
          **keys: Any) -> Study:
    """Runs many specimens: parameters, packings, angles, as `phyllite study`.

    source: a study file (TOML), or the recipe that the study starts from; its keys are then given here:
    study(recipe, "out", vary=[{"key": "bedding.k_n", "times": [0.5, 1, 2]}], packings=[1, 2, 3]). All keys:
    docs/reference.md. out: folder of the store; what it holds already is not run again, so that after Ctrl-C the
    same call goes on.
    """
    given = isinstance(source, _core.Recipe)
    if not given and not _is_path(source):
        raise TypeError(f"study: expected the name of a study file (TOML), or a Recipe; got {type(source).__name__}")
    if keys and not given:
        raise TypeError("keys of a study go with a recipe, not with a study file: " + ", ".join(keys))
    keys.setdefault("name", _os.path.basename(_os.path.abspath(_text(out))))
    return Study._of(_text(out), _core.study(source if given else _text(source), keys, _text(out), threads,
                                             _reporter(progress)))


_with_keys(study, "study")


# ---- calibration, as calibration.json has it (docs/formats.md)


def _number(value: Optional[float]) -> float:
    """JSON has no NaN: it stands as null there."""
    return _np.nan if value is None else value


@dataclass(frozen=True)
class Parameter:
    """What the data say about one parameter of the recipe."""

    key: str  #: "matrix.E_c", or a ratio, "tau_c/sigma_c"
    symbol: str
    value: float
    low: float  #: 95 % interval; NaN: the method gives none
    high: float
    unit: str
    determined: Optional[bool]  #: by the data; else next_test says what would. None: the method gives no interval
    rests_on: str
    next_test: str

    @staticmethod
    def _of(row: Dict[str, Any]) -> "Parameter":
        numbers = {name: _number(row[name]) for name in ("value", "low", "high")}
        return Parameter(row["key"], row["symbol"], **numbers, unit=row["unit"], determined=row["determined"],
                         rests_on=row.get("rests_on", {}).get("text", ""), next_test=row.get("next", {}).get("text", ""))


@dataclass(frozen=True)
class Comparison:
    """Laboratory beside model."""

    property: str  #: "E", "nu", "UCS", "DTS", "BTS", "sigma_1", "sigma_ci", "K_Ic", ...
    unit: str  #: of laboratory and model
    theta: float  #: [deg]
    confining: float  #: [Pa]; of tau_peak and tau_residual the normal stress
    diameter: float  #: [m] of a disc or half disc; 0: the model's
    laboratory: float  #: mean [Pa], nu [1], K_Ic [Pa sqrt(m)]
    laboratory_sd: float  #: of single specimens
    n: int  #: specimens
    model: float  #: mean over packings
    model_sd: float  #: between packings
    n_packings: int
    error: float  #: model/laboratory - 1
    with_discrepancy: float  #: model with what it misses of the table at other angles; NaN: no strength
    low: float  #: 95 % interval of the rock's value by the fit
    high: float
    missing: str  #: why there is no answer
    bedding_share: float  #: of a strength: cracks along bedding over all cracks; NaN: no bedding
    bedding_share_sd: float  #: between packings
    failure_angle: float  #: [deg] in which cracks line up, like theta; NaN: they do not
    failure_angle_sd: float  #: [deg] between packings

    @staticmethod
    def _of(row: Dict[str, Any]) -> "Comparison":
        lab, failure, model = row["laboratory"], row.get("failure", {}), _number(row["model"])
        return Comparison(
            property=row["property"], unit=row["unit"], theta=row["theta [deg]"],
            confining=row.get("confining [Pa]", 0.0), diameter=row.get("diameter [m]", 0.0),
            laboratory=lab["mean"], laboratory_sd=_number(lab["sd"]), n=lab["n"],
            model=model, model_sd=_number(row["sd_of_packings"]), n_packings=row["n_packings"],
            error=model / lab["mean"] - 1.0, with_discrepancy=_number(row.get("with_discrepancy")),
            low=_number(row["low"]), high=_number(row["high"]), missing=row.get("missing", ""),
            bedding_share=_number(failure.get("bedding_share")),
            bedding_share_sd=_number(failure.get("bedding_share_sd")),
            failure_angle=_number(failure.get("angle [deg]")), failure_angle_sd=_number(failure.get("angle_sd [deg]")))


@dataclass(frozen=True)
class Finding:
    """What was found: kind, cells and numbers are data (docs/formats.md), `text` says it to people."""

    kind: str
    cells: List[Dict[str, Any]]  #: "property", "theta [deg]", "confining [Pa]", "diameter [m]"
    numbers: Dict[str, Any]  #: in SI; a list where a name has several
    text: str
    names: List[str] = _field(default_factory=list)
    advice: str = ""

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Verdict:
    """The answer."""

    status: str  #: "calibrated", "calibrated except", ... (docs/calibration.md)
    sentence: str  #: status, and how many values are met, missed and not decided
    lines: List[str]  #: good for; not good for; why and what next
    good_for: List[Finding]  #: tests of the table that are met, others that its parameters determine
    not_good_for: List[Finding]  #: tests that are missed or not decided, others that the table leaves open
    findings: List[Finding]  #: each limit with numbers
    causes: List[Finding]  #: of the misfit, the largest share first; what is left open where the table is met
    next: str  #: the step to take

    def __str__(self) -> str:
        return "\n".join([self.sentence, *self.lines])


@dataclass(frozen=True)
class Missed:
    """What a calibrated model misses of a strength (docs/theory/inference.md): multiply the model's number by a factor."""

    factor: float  #: rock/model, of the estimate
    sd: float  #: standard deviation of the logarithm of the factor
    of_draws: List[float]  #: rock/model of each recipe of `Calibration.ensemble`


class Calibration:
    """The result of a calibration; str() of it is the output of the command."""

    def __init__(self, content: str, recipe: Recipe, ensemble: List[Recipe], text: str, folder: str = "",
                 record: Any = None):
        self._content = content
        self._record = record  # of the calibration just made; it stays in this process
        self._text = text
        found = _json.loads(content)
        self.name: str = found["rock"]
        self.folder = folder  #: where its files are; "": nowhere
        #: the calibrated model, ready to run
        self.recipe = recipe
        #: joint draws of what is known of it, as recipes
        self.ensemble = ensemble
        self.parameters = [Parameter._of(row) for row in found["parameters"]]
        rows = {name: [Comparison._of(row) for row in found.get(name, [])]
                for name in ("fitted", "verification", "left_out", "compared")}
        #: on the packings of the fit
        self.fitted = rows["fitted"]
        #: on packings that the fit has not seen
        self.verification = rows["verification"]
        #: each value predicted without it
        self.left_out = rows["left_out"]
        #: K_Ic on unseen packings, where nobody has stated the grain size: compared, not fitted
        self.compared = rows["compared"]
        verdict = found["verdict"]
        findings = {name: [Finding(**row) for row in verdict[name]]
                    for name in ("good_for", "not_good_for", "findings", "causes")}
        self.verdict = Verdict(verdict["status"], verdict["sentence"], verdict["lines"], **findings,
                               next=verdict["next"]["text"])
        self.notes = [Finding(**row) for row in found["notes"]]

    @property
    def table(self) -> List[Comparison]:
        """Laboratory beside model: on unseen packings where there are some, else on packings of the fit."""
        return self.verification or self.fitted

    def missed(self, property: str, theta: float = 0.0, confining: float = 0.0) -> Optional[Missed]:
        """What the model misses of a strength ("UCS", "BTS", "sigma_1") at theta [deg] under confining [Pa].

        None: the table has no such strength, so that this is not known.
        """
        row = _core.missed(self._content, self.folder or "calibration", property, theta, confining)
        return None if row is None else Missed(**row)

    def to_dict(self) -> Dict[str, Any]:
        """Everything, as calibration.json has it (docs/formats.md)."""
        return _json.loads(self._content)

    def plot(self, ax: Any = None) -> Any:
        """A Matplotlib figure: laboratory, model, intervals and values left out over the angle, a panel per test."""
        return _drawing.draw(_core.calibration_figure(self._content, self.folder or "calibration"), ax)

    def save(self, folder: Path) -> None:
        """Writes the files that `phyllite calibrate` leaves, but for the store of its tests."""
        if self._record is not None:
            self._record.save(_text(folder))
        elif self.folder:
            _shutil.copytree(self.folder, _text(folder), ignore=_shutil.ignore_patterns("runs.sqlite*", ".*"))
        else:
            raise ValueError("save: this calibration has come from another process without files; save it there")

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_record": None}

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<phyllite.Calibration of \"{self.name}\": {self.verdict.status}>"

    def _repr_html_(self) -> str:
        rows = _rows_in_lab_units(self.table)
        head = ["property", "unit", "theta [deg]", "laboratory", "model", "error [%]"]
        cells = [[r["property"], r["unit"], r["theta"], r["laboratory"], r["model"], 100.0 * r["error"]] for r in rows]
        return _notebook.paragraphs([f"{self.name}: {self.verdict.sentence}", *self.verdict.lines]) + _notebook.table(
            head, cells)


def calibrate(rock: Union[Rock, Path], out: Optional[Path] = None, *, threads: int = 0,
              progress: ProgressFunction = None, **options: Any) -> Calibration:
    """Micro-parameters from a laboratory table, verified on unseen packings, with a verdict (docs/calibration.md).

    rock: a Rock, or the name of its file.
    out: a folder as `phyllite calibrate` leaves it. Finished tests are kept there, and after Ctrl-C the same call
    with resume=True goes on. Without it nothing is kept.
    """
    given = {name: value for name, value in options.items() if value is not None}
    _inspect.signature(calibrate).bind(rock, out, **given)  # an argument that there is not
    made = _core.calibrate(_rock(rock, "calibrate")._record, {**given, "out": _text(out)}, threads, _reporter(progress))
    return Calibration(made.json(), made.recipe, made.ensemble, made.text(), _text(out), made)


def _with_options(function: Any, options: Any) -> None:
    """The options of a job in signature and documentation of its function."""
    fixed = [p for p in _inspect.signature(function).parameters.values() if p.kind is not p.VAR_KEYWORD]
    new = [row for row in options if row[0] not in {p.name for p in fixed}]
    function.__signature__ = _inspect.Signature(fixed + [
        _inspect.Parameter(name, _inspect.Parameter.KEYWORD_ONLY, default=default) for name, default, _, _ in new])
    function.__doc__ += "\n" + "".join(f"    {name}: {meaning} ({allowed})\n" for name, _, allowed, meaning in new)


_with_options(calibrate, _core.calibration_options())


# ---- what lies on the disk


def _read(*names: str) -> str:
    try:
        with open(_os.path.join(*names), encoding="utf-8") as file:
            return file.read()
    except OSError as reason:
        raise IoError(f"{_os.path.join(*names)}: cannot be read ({reason.strerror}); a calibration that was stopped goes on "
                      "with calibrate(..., resume=True)") from None


def _load_calibration(folder: str) -> Calibration:
    content = _read(folder, "calibration.json")
    _core.calibration_figure(content, _os.path.join(folder, "calibration.json"))  # refuses what is none of this format
    draws = sorted(_glob.glob(_os.path.join(_glob.escape(folder), "ensemble", "*.toml")))
    return Calibration(content, Recipe.from_file(_os.path.join(folder, "calibrated.toml")),
                       [Recipe.from_file(path) for path in draws], _read(folder, "tables.txt"), folder)


def load(folder: Path) -> Union[Result, Calibration, Study]:
    """What `phyllite run`, `calibrate` or `study`, the page or an earlier notebook has left in a folder.

    A Result, Calibration or Study as run(), calibrate() and study() return it. A Result from a folder has no last state of
    grains and contacts; a Calibration prints tables.txt. Specimens that the recipe names and that are not there are warned
    of. Raises IoError, or InputError where the folder holds no result.
    """
    path = _text(folder)
    if _os.path.exists(_os.path.join(path, "calibration.json")):
        return _load_calibration(path)
    if _os.path.exists(_os.path.join(path, "study.sqlite")):
        return Study._of(path, _core.load_study(path))
    tests, missing = _core.load_run(path)
    for line in missing:
        _warnings.warn(line, stacklevel=2)
    return Result(tests[0].recipe, tests, path)


# ---- one contact


@dataclass(frozen=True)
class LawParameter:
    """A parameter of a contact law."""

    name: str
    unit: str
    typical: float
    low: float
    high: float
    meaning: str
    pfc_name: str


@dataclass(frozen=True)
class ContactLaw:
    """A contact law of the list; its equations are in src/laws/NAME/README.md."""

    name: str
    sentence: str
    parameters: List[LawParameter]


def contact_laws() -> List[ContactLaw]:
    """All contact laws with their parameters."""
    return [ContactLaw(name, sentence, [LawParameter(*p) for p in parameters])
            for name, sentence, parameters in _core.contact_laws()]


def contact(law: str, path: Any = None, *, steps: int = 100, **parameters: Any) -> _np.ndarray:
    """Drives one contact along a path, as `phyllite contact`: contact("smooth_joint", k_n="1e10 N/m").

    path: corners (closure [m], slide [m], rotation [rad]) as rows of numbers, or as texts "1 um, 8 um, 0 deg".
    None: a path that shows everything.
    steps: from corner to corner.
    parameters: values with units; contact_laws() lists them.

    An array of rows: closure, slide [m], rotation [rad], F_n, F_s [N/m], M [N], the closed form's F_n_exact,
    F_s_exact, M_exact, dissipated, released, stored [J/m], broke (1 tension, 2 shear).
    """
    return _core.contact(law, path, [f"{name}={value}" for name, value in parameters.items()], steps)
