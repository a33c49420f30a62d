from os import PathLike
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np

from . import theory as theory

__version__: str

class Recipe:
    def __init__(self, **keys: Any) -> None: ...
    @staticmethod
    def from_file(path: Union[str, PathLike[str]]) -> Recipe: ...
    @staticmethod
    def from_toml(text: str, where: str = ...) -> Recipe: ...
    def changed(self, **keys: Any) -> Recipe: ...
    def __getitem__(self, key: str) -> Any: ...
    def __eq__(self, other: object) -> bool: ...
    def to_toml(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def specimens(self) -> List[str]: ...

class RockRecord:
    @staticmethod
    def from_toml(path: str) -> RockRecord: ...
    @staticmethod
    def from_base(name: str) -> RockRecord: ...
    @staticmethod
    def from_keys(keys: Dict[str, Any], where: str, table: Optional[str]) -> RockRecord: ...
    name: str
    notes: List[str]
    targets: List[Dict[str, Any]]
    findings: str
    def check(self) -> str: ...

class Number:
    name: str
    value: float
    unit: str
    definition: str
    note: str
    upper_bound: bool
    def __float__(self) -> float: ...

class Specimen:
    name: str
    theta: float
    intact: bool
    status: str
    has_strength: bool
    reason: str
    advice: str
    numbers: Dict[str, Number]
    hash: str
    columns: List[Tuple[str, str, str]]
    history: np.ndarray
    cracks: np.ndarray
    discs: np.ndarray
    grains: np.ndarray
    contacts: np.ndarray
    n_steps: int
    seconds: float

class CalibrationRecord:
    name: str
    recipe: Recipe
    ensemble: List[Recipe]
    notes: List[Dict[str, Any]]
    status: str
    sentence: str
    findings: List[Dict[str, Any]]
    causes: List[Dict[str, Any]]
    lines: List[str]
    good_for: List[Dict[str, Any]]
    not_good_for: List[Dict[str, Any]]
    next: str
    parameters: List[Dict[str, Any]]
    fitted: List[Dict[str, Any]]
    verification: List[Dict[str, Any]]
    left_out: List[Dict[str, Any]]
    compared: List[Dict[str, Any]]
    def missed(self, property: str, theta: float, confining: float) -> Optional[Dict[str, Any]]: ...
    def text(self) -> str: ...
    def json(self) -> str: ...
    def save(self, folder: str) -> None: ...

Reporter = Optional[Callable[[str, int, int], Any]]

def explain(key: str) -> str: ...
def keys() -> Dict[str, List[str]]: ...
def run(recipe: Recipe, folder: str, replace: bool, threads: int, progress: Reporter) -> List[Specimen]: ...
def elastic(
    recipe: Recipe, glued: bool, modulus_loss: bool, threads: int, progress: Reporter
) -> Tuple[List[Dict[str, Any]], List[Dict[str, Any]], List[Dict[str, Any]]]: ...
def contact(law: str, path: Any, values: List[str], steps: int) -> np.ndarray: ...
def contact_laws() -> List[Tuple[str, str, List[Tuple[str, str, float, float, float, str, str]]]]: ...
def calibration_options() -> List[Tuple[str, Any, str, str]]: ...
def rocks() -> List[str]: ...
def calibrate(rock: RockRecord, options: Dict[str, Any], threads: int, progress: Reporter) -> CalibrationRecord: ...
def study(
    source: Union[str, Recipe], keys: Dict[str, Any], folder: str, threads: int, progress: Reporter
) -> Dict[str, str]: ...
