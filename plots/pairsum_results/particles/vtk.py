"""VTK XML and legacy files (SPHinXsys, TrixiParticles, AutoPas, SPlisHSPlasH, DualSPHysics' PartVTK) by python3-vtk9.

https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
"""
import pathlib
import re

import numpy as np

from ..rows import ResultsError
from .source import Source, library, reading


def read(path: pathlib.Path, legacy: bool) -> list[Source]:
    """The points of a file with their data; what its cells are does not matter."""
    core = library("vtkmodules.vtkCommonCore", "python3-vtk9", path)
    as_numpy = library("vtkmodules.util.numpy_support", "python3-vtk9", path).vtk_to_numpy
    model = library("vtkmodules.vtkCommonDataModel", "python3-vtk9", path)
    if legacy:
        reader = library("vtkmodules.vtkIOLegacy", "python3-vtk9", path).vtkGenericDataObjectReader()
        for what in ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "Fields"):
            getattr(reader, f"ReadAll{what}On")()
    else:
        reader = library("vtkmodules.vtkIOXML", "python3-vtk9", path).vtkXMLGenericDataObjectReader()
    reader.SetFileName(str(path))
    said = core.vtkStringOutputWindow()
    before = core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(said)
    try:
        reader.Update()
    finally:
        core.vtkOutputWindow.SetInstance(before)
    if problem := said.GetOutput():
        first = re.sub(r"\A.*?\(0x[0-9a-f]+\): ", "", problem, flags=re.S).split("\n\n")[0]
        raise ResultsError(f"{path} cannot be read as VTK: {' '.join(first.split())}")
    data = reader.GetOutput()
    if not isinstance(data, model.vtkPointSet):
        what = data.GetClassName() if data else "nothing"
        raise ResultsError(f"{path} holds no particles but {what}; pairsum wants PolyData or UnstructuredGrid")
    if not data.GetPoints():
        raise ResultsError(f"{path} has no points")
    with reading(path, "VTK"):
        columns = {"Points": as_numpy(data.GetPoints().GetData())}
        values = data.GetPointData()
        for k in range(values.GetNumberOfArrays()):
            if array := values.GetArray(k):  # none if it holds texts
                columns[array.GetName() or f"array {k}"] = as_numpy(array)
        return [_source(path, columns, data, as_numpy, legacy)]


def _source(path: pathlib.Path, columns: dict[str, np.ndarray], data, as_numpy, legacy: bool) -> Source:
    """With what a file says of all particles: TrixiParticles' `smoothing_length`, `ndims` and `time`, `TimeValue`."""
    field = data.GetFieldData()
    one = {}
    for k in range(field.GetNumberOfArrays()):
        array = field.GetArray(k)
        if array and array.GetNumberOfValues() == 1:
            one[str(array.GetName()).lower()] = as_numpy(array).reshape(-1)[0]
    if "smoothing_length" in one:
        columns.setdefault("smoothing_length", np.full(len(columns["Points"]), float(one["smoothing_length"])))
    time = one.get("timevalue", one.get("time"))
    return Source(path, f"VTK {'legacy' if legacy else 'XML'}", columns, time=None if time is None else float(time),
                  dim=int(one["ndims"]) if one.get("ndims") in (1, 2, 3) else None, unit="VTK names none")
