#!/usr/bin/env python3
"""Opens every snapshot of results with VTK's reader and holds it against the CSV files beside it. Exit 1 with the
reason when something does not fit."""
import csv
import math
import pathlib
import sys
import xml.etree.ElementTree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

ARRAYS = {
    "grains": {"radius", "displacement", "rotation"},
    "contacts": {"F_n", "F_s", "kind", "broken"},
    "cracks": {"mode", "place", "strain", "energy"},
}


def read(path):
    reader = vtkXMLPolyDataReader()
    if not reader.CanReadFile(str(path)):
        sys.exit(f"{path}: VTK cannot read it")
    reader.SetFileName(str(path))
    reader.Update()
    if reader.GetErrorCode() != 0:
        sys.exit(f"{path}: VTK reports error {reader.GetErrorCode()}")
    return reader.GetOutput()


def arrays_of(data):
    found = {}
    for attributes in (data.GetPointData(), data.GetCellData()):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)
            found[array.GetName().split(" [")[0]] = [array.GetComponent(k, c) for k in range(array.GetNumberOfTuples())
                                      for c in range(array.GetNumberOfComponents())]
    return found


def check(path, n_cracks):
    kind = path.name.split("_")[0].split(".")[0]
    data = read(path)
    found = arrays_of(data)
    missing = ARRAYS[kind] - set(found)
    if missing:
        sys.exit(f"{path}: no array {', '.join(sorted(missing))}; found {', '.join(sorted(found))}")
    for name, values in found.items():
        if not all(map(math.isfinite, values)):
            sys.exit(f"{path}: {name} holds what is no number")
    if kind == "grains" and (data.GetNumberOfPoints() != 330 or min(found["radius"]) <= 0.0):
        sys.exit(f"{path}: {data.GetNumberOfPoints()} grains, smallest radius {min(found['radius'])}")
    if kind == "contacts" and (data.GetNumberOfLines() < 330 or len(found["F_n"]) != data.GetNumberOfLines()):
        sys.exit(f"{path}: {data.GetNumberOfLines()} lines, {len(found['F_n'])} forces")
    if kind == "cracks" and data.GetNumberOfLines() != n_cracks:
        sys.exit(f"{path}: {data.GetNumberOfLines()} cracks, cracks.csv has {n_cracks}")


results = sorted(p.parent for p in pathlib.Path(sys.argv[1]).rglob("result.json"))
n_files = 0
for folder in results:
    with open(folder / "cracks.csv") as file:
        n_cracks = len(list(csv.reader(line for line in file if not line.startswith("#")))) - 1
    for path in sorted(folder.rglob("*.vtp")):
        check(path, n_cracks)
        n_files += 1
    for pvd in folder.glob("*.pvd"):
        for entry in xml.etree.ElementTree.parse(pvd).iter("DataSet"):
            if not (folder / entry.get("file")).exists():
                sys.exit(f"{pvd}: names {entry.get('file')}, which is not there")
print(f"{len(results)} results, {n_files} files")
