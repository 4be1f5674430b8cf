"""Opens VTP files with VTK: points, polygons or lines and arrays must be there and finite, normals of length one."""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
import numpy

ARRAYS = ["H", "K", "k1", "k2"]


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    points, cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
    assert reader.GetErrorCode() == 0 and points > 0 and cells > 0, f"{path}: {points} points, {cells} cells"
    assert numpy.isfinite(vtk_to_numpy(data.GetPoints().GetData())).all(), f"{path}: points are not finite"
    return data


def check_shape(path):
    data = read(path)
    points, cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
    arrays = data.GetPointData()
    names = [arrays.GetArrayName(k) for k in range(arrays.GetNumberOfArrays())]
    for name in ARRAYS:
        assert name in names, f"{path}: no array {name}, only {names}"
        values = vtk_to_numpy(arrays.GetArray(name))
        assert len(values) == points, f"{path}: {name} has {len(values)} values for {points} points"
        assert numpy.isfinite(values).all(), f"{path}: {name} is not finite"
    assert arrays.GetNormals(), f"{path}: no normals"
    length = numpy.linalg.norm(vtk_to_numpy(arrays.GetNormals()), axis=1)
    # 1e-12: rounding of a norm, 2e-16, with room for cancellation near a pole
    assert abs(length - 1).max() < 1e-12, f"{path}: normals of length {length.min()} to {length.max()}"
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    assert corners.min() >= 0 and corners.max() < points, f"{path}: a polygon names point {corners.max()}"
    triangles = vtkTriangleFilter()
    triangles.SetInputData(data)
    mass = vtkMassProperties()
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    assert mass.GetSurfaceArea() > 0, f"{path}: area {mass.GetSurfaceArea()}"
    print(f"{path}: {points} points, {cells} polygons, area {mass.GetSurfaceArea():.6g}, arrays {', '.join(names)}")


def check_spines(path):
    """One line for each patch, from u = 0 to u = 1, that uses each of its points once."""
    data = read(path)
    points, lines = data.GetNumberOfPoints(), data.GetLines()
    assert lines.GetNumberOfCells() == data.GetNumberOfCells(), f"{path}: not lines alone"
    u, patch = (vtk_to_numpy(data.GetPointData().GetArray(name)) for name in ("u", "patch"))
    names = data.GetFieldData().GetAbstractArray("patches")
    corners, ends = (vtk_to_numpy(array) for array in (lines.GetConnectivityArray(), lines.GetOffsetsArray()))
    assert sorted(corners) == list(range(points)), f"{path}: points that no line has, or more than one"
    owners = []
    for line in numpy.split(corners, ends[1:-1]):
        assert u[line[0]] == 0 and u[line[-1]] == 1 and (numpy.diff(u[line]) > 0).all(), f"{path}: u is {u[line]}"
        assert (patch[line] == patch[line[0]]).all(), f"{path}: a line of the patches {patch[line]}"
        owners.append(names.GetValue(patch[line[0]]))
    assert len(set(owners)) == len(owners), f"{path}: two spines of one patch, {owners}"
    print(f"{path}: {points} points, spines of {', '.join(owners)}")


for file in sys.argv[1:]:
    if file.endswith("-spines.vtp"):
        check_spines(file)
    else:
        check_shape(file)
