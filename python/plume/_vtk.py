"""Data sets of PyVista and VTK, told by what they can do: neither is imported before one is met."""

import numpy as np

from ._plume import Error

# vtkDataObject.GetDataObjectType()
STRUCTURED_GRID, RECTILINEAR_GRID, UNSTRUCTURED_GRID, IMAGE_DATA = 2, 3, 4, 6
HIDDEN_CELL = 32  # vtkDataSetAttributes.HIDDENCELL
HIDDEN_OR_DUPLICATE = HIDDEN_CELL | 1
REALS = (np.dtype(np.float32), np.dtype(np.float64))


def is_dataset(thing):
    """Whether this is a data set, and not an array of points."""
    return hasattr(thing, "GetDataObjectType") or (
        hasattr(thing, "points") and hasattr(thing, "cells") and hasattr(thing, "celltypes"))


def fill_from_dataset(mesh, data):
    """Lets a plume.Mesh read a data set's arrays."""
    if not hasattr(data, "GetDataObjectType"):
        fill_from_attributes(mesh, data)
        return
    from vtkmodules.util.numpy_support import vtk_to_numpy

    kind = data.GetDataObjectType()
    if kind == UNSTRUCTURED_GRID:
        mesh._set_points(vtk_to_numpy(data.GetPoints().GetData()))
        cells = data.GetCells()
        faces = data.GetFaces()
        mesh._set_vtk_cells(
            vtk_to_numpy(cells.GetConnectivityArray()), vtk_to_numpy(cells.GetOffsetsArray()),
            vtk_to_numpy(data.GetCellTypesArray()),
            vtk_to_numpy(faces) if faces else None,
            vtk_to_numpy(data.GetFaceLocations()) if faces else None)
    elif kind == STRUCTURED_GRID:
        mesh._set_points(vtk_to_numpy(data.GetPoints().GetData()))
        mesh._native.set_dimensions(data.GetDimensions())
    elif kind == RECTILINEAR_GRID:
        mesh._native.set_axes([mesh._array(vtk_to_numpy(axis), f"axis {name}", REALS, (None,))
                               for axis, name in ((data.GetXCoordinates(), "x"),
                                                  (data.GetYCoordinates(), "y"),
                                                  (data.GetZCoordinates(), "z"))])
    elif kind == IMAGE_DATA:
        turned = data.GetDirectionMatrix()
        if any(turned.GetElement(i, j) != (i == j) for i in range(3) for j in range(3)):
            raise Error("an image whose axes are turned: cast it to a structured grid")
        first = data.GetExtent()[::2]
        mesh._native.set_axes([
            data.GetOrigin()[a] + data.GetSpacing()[a] * (first[a] + np.arange(n, dtype=float))
            for a, n in enumerate(data.GetDimensions())])
    else:
        raise Error(f"a {data.GetClassName()}: give an unstructured grid, a structured or "
                    "rectilinear one, or an image")

    for attributes, association in ((data.GetPointData(), "point"), (data.GetCellData(), "cell")):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)  # None where it holds no numbers
            if array is None:
                continue
            values = vtk_to_numpy(array)
            if array.GetName() == "vtkGhostType":
                if association == "cell" and kind != UNSTRUCTURED_GRID:
                    mesh._native.set_hidden_cells(
                        (values & HIDDEN_OR_DUPLICATE).astype(np.uint8))
                continue
            mesh.add_field(array.GetName(), values, association)


def fill_from_attributes(mesh, data):
    """What looks like a PyVista mesh without being VTK's."""
    mesh._set_points(data.points)
    if hasattr(data, "cell_connectivity") and hasattr(data, "offset"):
        mesh._set_vtk_cells(data.cell_connectivity, data.offset, data.celltypes)
    else:
        # Each cell is its count, then its points.
        flat, types = np.asarray(data.cells), np.asarray(data.celltypes)
        starts = np.empty(len(types), np.int64)
        at = 0
        for cell in range(len(types)):
            if at >= len(flat):
                raise Error(f"cells end before cell {cell} of {len(types)}")
            starts[cell] = at
            at += 1 + int(flat[at])
        keep = np.ones(len(flat), bool)
        keep[starts] = False
        offsets = np.append(starts - np.arange(len(types)), at - len(types))
        mesh._set_vtk_cells(flat[keep], offsets, types)
        mesh.copied.append("cells")
    for association in ("point", "cell"):
        for name, values in dict(getattr(data, f"{association}_data", {})).items():
            mesh.add_field(name, values, association)
