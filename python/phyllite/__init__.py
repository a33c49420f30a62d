"""Phyllite: a laboratory for layered rock.

    import phyllite
    recipe = phyllite.Recipe(bedding=[{}], test={"angles": [f"{a} deg" for a in range(0, 91, 15)]})
    result = phyllite.run(recipe, progress=print)
    for specimen in result:
        print(specimen.theta, specimen.numbers["ucs"])

These lines break the paper's specimen at seven inclinations of its bedding. SI units and degrees; compression and
shortening positive; theta is the inclination of the bedding planes, the load being vertical (docs/conventions.md).

Functions that take long release the interpreter lock, end soon on Ctrl-C (KeyboardInterrupt) and call
`progress`, if given, with a Progress now and then. threads=0 means all cores.
"""
import csv as _csv
import inspect as _inspect
import io as _io
import json as _json
import os as _os
import sys as _sys
from collections.abc import Sequence as _Sequence
from dataclasses import asdict as _asdict
from dataclasses import dataclass
from dataclasses import is_dataclass as _is_dataclass
from typing import Any, Callable, Dict, Iterator, List, Optional, Union

import numpy as _np

from . import _core
from ._core import Number, Recipe, Specimen, __version__, theory
from .errors import Error, InputError, InternalError, IoError, Problem
from .names import known as _known_name

_sys.modules[__name__ + ".theory"] = theory

Path = Union[str, "_os.PathLike[str]"]

__all__ = ["Calibration", "Comparison", "ContactLaw", "Elastic", "Error", "Finding", "InputError", "InternalError",
           "IoError", "LawParameter", "Missed", "Number", "Parameter", "Problem", "Progress", "Recipe", "Result", "Rock", "Specimen",
           "Study", "Target", "Verdict", "calibrate", "contact", "contact_laws", "elastic", "explain", "frame", "rock",
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


ProgressFunction = Optional[Callable[[Progress], Any]]


def _reporter(progress: ProgressFunction) -> Optional[Callable[[str, int, int], Any]]:
    return None if progress is None else lambda text, done, total: progress(Progress(text, done, total))


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
    """A recipe, or that of a file."""
    if isinstance(value, _core.Recipe):
        return value
    if _is_path(value):
        return _core.Recipe.from_file(value)
    raise TypeError(f"{function}: expected a Recipe, or the name of a recipe file (TOML); got {type(value).__name__}")


def frame(rows: Any) -> Any:
    """A pandas DataFrame of a result: Result, list of parameters or comparisons, history, cracks ..."""
    import pandas

    if hasattr(rows, "_frame_rows"):
        rows = rows._frame_rows()
    if not isinstance(rows, _np.ndarray):
        rows = [_asdict(row) if _is_dataclass(row) else row for row in rows]
    return pandas.DataFrame(rows)


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


class Rock:
    """A rock as a laboratory saw it: a table of tests.

    Columns carry their unit: theta [deg], E [GPa], nu, UCS [MPa], DTS [MPa], BTS [MPa], K_Ic [MPa sqrt(m)], n ...
    (docs/formats.md, "Rock").
    """

    def __init__(self, record: Any):
        if not isinstance(record, _core.RockRecord):
            raise TypeError("a Rock comes from Rock.from_toml, Rock.from_csv or Rock.from_dataframe")
        self._record = record

    @staticmethod
    def from_toml(path: Path) -> "Rock":
        """The rock of a rock file. Raises IoError, or InputError with every problem of all its files."""
        return Rock(_core.RockRecord.from_toml(_text(path)))

    @staticmethod
    def from_csv(path: Path, **keys: Any) -> "Rock":
        """The rock of a table, with keys of a rock file: Rock.from_csv("shale.csv", E_is="secant 50 %").

        Workbooks are tables too: Rock.from_csv("shale.xlsx", sheet="UCS", columns={"peak stress": "UCS"}). recipe may
        be a Recipe or the name of a file. Raises IoError, or InputError with every problem found.
        """
        stem = _os.path.splitext(_os.path.basename(_text(path)))[0]
        return Rock(_core.RockRecord.from_keys({"name": stem, **keys, "data": _text(path)}, "Rock.from_csv", None))

    @staticmethod
    def from_dataframe(frame: Any, **keys: Any) -> "Rock":
        """The rock of a pandas DataFrame with the columns of a table; keys as of from_csv.

        Its index is passed over. Lines in messages count from the names of the columns: the first row is line 2.
        """
        if not hasattr(frame, "to_csv"):
            raise TypeError(f"Rock.from_dataframe: expected a pandas DataFrame; got {type(frame).__name__}")
        return Rock(_core.RockRecord.from_keys({"name": "rock", **keys, "data": "DataFrame"}, "Rock.from_dataframe",
                                               frame.to_csv(index=False)))

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


_with_keys(Rock.from_csv, "rock")
_with_keys(Rock.from_dataframe, "rock")


def _rock(value: Any, function: str) -> Rock:
    """A rock, or that of a file."""
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
    return Rock(_core.RockRecord.from_base(name))


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

    def __repr__(self) -> str:
        return f"<phyllite.Result of {len(self)} specimens>"


def run(recipe: Union[Recipe, Path], out: Optional[Path] = None, *, replace: bool = False, threads: int = 0,
        progress: ProgressFunction = None) -> Result:
    """Runs the laboratory test of a recipe on all its specimens.

    recipe: a Recipe, or the name of its file. out: a folder that is filled as `phyllite run` fills it, each specimen as soon as it is finished; after Ctrl-C
    they are kept there. replace: results of another recipe are removed from it. The numbers and hashes are those of
    the program, whatever the number of threads. Raises InputError, IoError.
    """
    recipe = _recipe(recipe, "run")
    tests = _core.run(recipe, _text(out), replace, threads, _reporter(progress))
    return Result(recipe, tests, _text(out))


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
    found = _core.study(source if given else _text(source), keys, _text(out), threads, _reporter(progress))
    tables = {name: _table(found.get(name, "")) for name in ("table", "responses", "effects")}
    return Study(folder=_text(out), text=found.get("text", ""), hash=found.get("hash", ""), **tables)


_with_keys(study, "study")


# ---- calibration


@dataclass(frozen=True)
class Parameter:
    """What the data say about one parameter of the recipe."""

    key: str  #: "matrix.E_c", or a ratio, "tau_c/sigma_c"
    symbol: str
    value: float
    low: float  #: 95 % interval; NaN: the method gives none
    high: float
    unit: str
    determined: bool  #: by the data; else next_test says what would
    rests_on: str
    next_test: str


@dataclass(frozen=True)
class Comparison:
    """Laboratory beside model."""

    property: str  #: "E", "nu", "UCS", "DTS", "BTS", "sigma_1", "sigma_ci", "K_Ic", ...
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


@dataclass(frozen=True)
class Finding:
    """What was found: kind, cells and numbers are data (docs/formats.md), `text` says it to people."""

    kind: str
    cells: List[Dict[str, Any]]  #: property, theta [deg], confining [Pa], diameter [m]
    numbers: Dict[str, float]  #: in SI
    names: List[str]
    advice: str
    text: str

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
    """What a calibration has found; str() of it is what the command prints."""

    def __init__(self, record: Any):
        self._record = record
        #: the calibrated model, ready to run
        self.recipe: Recipe = record.recipe
        #: joint draws of what is known of it, as recipes
        self.ensemble: List[Recipe] = record.ensemble
        self.parameters = [Parameter(**row) for row in record.parameters]
        #: on the packings of the fit
        self.fitted = [Comparison(**row) for row in record.fitted]
        #: on packings that the fit has not seen
        self.verification = [Comparison(**row) for row in record.verification]
        #: each value predicted without it
        self.left_out = [Comparison(**row) for row in record.left_out]
        #: K_Ic on unseen packings, where nobody has stated the grain size: compared, not fitted
        self.compared = [Comparison(**row) for row in record.compared]
        findings = [[Finding(**row) for row in rows] for rows in (record.good_for, record.not_good_for, record.findings, record.causes)]
        self.verdict = Verdict(record.status, record.sentence, record.lines, *findings, record.next)
        self.notes = [Finding(**row) for row in record.notes]

    @property
    def table(self) -> List[Comparison]:
        """Laboratory beside model: on unseen packings where there are some, else on those of the fit."""
        return self.verification or self.fitted

    def missed(self, property: str, theta: float = 0.0, confining: float = 0.0) -> Optional[Missed]:
        """What the model misses of a strength ("UCS", "BTS", "sigma_1") at theta [deg] under confining [Pa].

        None: the table has no such strength, so that this is not known.
        """
        row = self._record.missed(property, theta, confining)
        return None if row is None else Missed(**row)

    def to_dict(self) -> Dict[str, Any]:
        """Everything, as calibration.json has it (docs/formats.md)."""
        return _json.loads(self._record.json())

    def save(self, folder: Path) -> None:
        """Writes the files that `phyllite calibrate` leaves, but for the store of its tests."""
        self._record.save(_text(folder))

    def __str__(self) -> str:
        return self._record.text()

    def __repr__(self) -> str:
        return f"<phyllite.Calibration of \"{self._record.name}\": {self.verdict.status}>"


def calibrate(rock: Union[Rock, Path], out: Optional[Path] = None, *, threads: int = 0,
              progress: ProgressFunction = None, **options: Any) -> Calibration:
    """Micro-parameters from a laboratory table, verified on unseen packings, with a verdict (docs/calibration.md).

    rock: a Rock, or the name of its file. out: a folder as `phyllite calibrate` leaves it; every test is kept there as
    soon as it is finished, and after Ctrl-C the same call with resume=True goes on. Without it nothing is kept.
    """
    given = {name: value for name, value in options.items() if value is not None}
    _inspect.signature(calibrate).bind(rock, out, **given)  # an argument that there is not
    return Calibration(_core.calibrate(_rock(rock, "calibrate")._record, {**given, "out": _text(out)}, threads,
                                       _reporter(progress)))


def _with_options(function: Any, options: Any) -> None:
    """The options of a job in signature and documentation of its function."""
    fixed = [p for p in _inspect.signature(function).parameters.values() if p.kind is not p.VAR_KEYWORD]
    new = [row for row in options if row[0] not in {p.name for p in fixed}]
    function.__signature__ = _inspect.Signature(fixed + [
        _inspect.Parameter(name, _inspect.Parameter.KEYWORD_ONLY, default=default) for name, default, _, _ in new])
    function.__doc__ += "\n" + "".join(f"    {name}: {meaning} ({allowed})\n" for name, _, allowed, meaning in new)


_with_options(calibrate, _core.calibration_options())


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

    path: corners (closure [m], slide [m], rotation [rad]) as rows of numbers, or as texts "1 um, 8 um, 0 deg"; None:
    one that shows everything. steps: from corner to corner. parameters: values with units; contact_laws() lists them.

    An array of rows: closure, slide [m], rotation [rad], F_n, F_s [N/m], M [N], the closed form's F_n_exact,
    F_s_exact, M_exact, dissipated, released, stored [J/m], broke (1 tension, 2 shear).
    """
    return _core.contact(law, path, [f"{name}={value}" for name, value in parameters.items()], steps)
