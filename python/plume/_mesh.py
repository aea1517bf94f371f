"""The mesh that a user has, as the library reads it."""

import numpy as np

from . import _plume
from ._plume import Error
from ._vtk import fill_from_dataset, is_dataset

#: VTK's numbers of the cells there are, by name; meshio's names are understood as well.
CELL_TYPES = {
    "tetrahedron": 10, "voxel": 11, "hexahedron": 12, "wedge": 13, "pyramid": 14,
    "pentagonal prism": 15, "hexagonal prism": 16, "polyhedron": 42, "tetra": 10,
}
POINTS_OF_TYPE = {10: 4, 11: 8, 12: 8, 13: 6, 14: 5, 15: 10, 16: 12}
TYPE_OF_COLUMNS = {4: 10, 5: 14, 6: 13, 8: 12}

REALS = (np.dtype(np.float32), np.dtype(np.float64))
INTEGERS = (np.dtype(np.int32), np.dtype(np.int64))
NUMBERS = (*REALS, *INTEGERS, np.dtype(np.uint8))


class Mesh:
    """Points, cells and fields, in NumPy arrays that are read where they are.

    Parameters
    ----------
    points : (n, 3) floats, or a PyVista or VTK data set
        Coordinates. A data set brings its cells and all of its fields along, and further arguments
        but `fields` are then not allowed. Explicit cells (vtkUnstructuredGrid), curvilinear and
        rectilinear grids and images are understood, and any object with `points`, `cells` (each
        preceded by its count, as VTK had it of old) and `celltypes`.
    cells : optional
        Numbers of points, from 0 and in VTK's order, as one of

        - an (m, 4), (m, 5), (m, 6) or (m, 8) array: tetrahedra, pyramids, wedges, hexahedra;
        - a dict from a type (a name such as "tetrahedron", or VTK's number) to an array with a row
          for each cell; cells are numbered in the order of the dict;
        - VTK's `(connectivity, offsets, types)`, to which polyhedra add
          `(..., faces, face_locations)`.
    dimensions : three integers, optional
        For a curvilinear grid instead of cells: points along i, j and k; point (i, j, k) is number
        ``i + ni * (j + nj * k)``.
    axes : three arrays, optional
        For a rectilinear grid instead of points and cells: its coordinates along x, y and z.
    hidden : uint8 array, optional
        Grids only: nonzero for each cell that is not to be seen.
    fields : dict from names to arrays, optional
        One value (or row of components) for each point or each cell; where there are as many points
        as cells, of points. See also :meth:`add_field`.

    Arrays of float32, float64, int32 and int64 (uint8 for types) that are contiguous in memory are
    not copied; others are, once, and listed in :attr:`copied`. Do not change an array's size, points or
    cells while the mesh is in use. Values of fields may change: see :meth:`Scene.set_field`.
    """

    def __init__(self, points=None, cells=None, *, dimensions=None, axes=None, hidden=None,
                 fields=None):
        self._native = _plume.Mesh()
        #: Names of the arrays that could not be read where they are.
        self.copied = []
        if is_dataset(points):
            if any(given is not None for given in (cells, dimensions, axes, hidden)):
                raise Error("a data set has its own cells: give it alone, or points and cells")
            fill_from_dataset(self, points)
        elif axes is not None:
            if points is not None or cells is not None or dimensions is not None:
                raise Error("axes make a rectilinear grid: give no points, cells or dimensions")
            if len(axes) != 3:
                raise Error(f"{len(axes)} axes: give the coordinates along x, y and z")
            self._native.set_axes([self._array(axis, f"axis {name}", REALS, (None,))
                                   for axis, name in zip(axes, "xyz")])
        elif points is None:
            raise Error("a mesh needs points (with cells or dimensions), axes, or a data set")
        else:
            self._set_points(points)
            if (cells is None) == (dimensions is None):
                raise Error("besides points, give either cells or a grid's dimensions")
            if cells is not None:
                self._set_cells(cells)
            else:
                self._native.set_dimensions([int(n) for n in dimensions])
        if hidden is not None:
            self._native.set_hidden_cells(
                self._array(hidden, "hidden", (np.dtype(np.uint8),), (None,)))
        for name, values in (fields or {}).items():
            self.add_field(name, values)

    def add_field(self, name, values, association=None):
        """Adds a field: one value, or row of components, for each point or cell.

        `association` is "point" or "cell"; None finds out by the number of values.
        """
        values = self._array(values, f"field '{name}'", NUMBERS, None)
        if values.ndim not in (1, 2):
            raise Error(f"field '{name}' has the shape {values.shape}: give (n,) or "
                        "(n, components)")
        if association is None:
            counts = {"point": self.point_count, "cell": self.cell_count}
            fitting = [kind for kind, count in counts.items() if count == len(values)]
            if not fitting:
                raise Error(f"field '{name}' has {len(values)} values, and there are "
                            f"{self.point_count} points and {self.cell_count} cells")
            association = fitting[0]
        elif association not in ("point", "cell"):
            raise Error(f"field '{name}': association '{association}' is neither 'point' nor "
                        "'cell'")
        components = values.shape[1] if values.ndim == 2 else 1
        self._native.add_field(str(name), association == "point", components, values)

    @property
    def point_count(self):
        """How many points there are."""
        return self._native.point_count

    @property
    def cell_count(self):
        """How many cells there are."""
        return self._native.cell_count

    @property
    def points(self):
        """The coordinates that the library reads: a read-only view, (n, 3)."""
        return self._native.points()

    @property
    def connectivity(self):
        """The numbers of points that the library reads: a read-only view, flat."""
        return self._native.connectivity()

    @property
    def fields(self):
        """The values that the library reads, by name: read-only views."""
        return self._native.fields()

    def __repr__(self):
        return (f"<plume.Mesh of {self.point_count} points and {self.cell_count} cells; fields: "
                f"{', '.join(self.fields) or 'none'}>")

    # An array that the library can read where it is; None in `shape` stands for any number.
    def _array(self, values, name, dtypes, shape):
        given = np.asarray(values)
        if given.dtype.kind not in "fiub":
            raise Error(f"{name}: values of type {given.dtype}; give numbers")
        wanted = given.dtype
        if wanted not in dtypes:
            integral = given.dtype.kind in "iub"
            kind = INTEGERS if integral and set(INTEGERS) <= set(dtypes) else dtypes
            wanted = kind[-1] if kind is not NUMBERS else np.dtype(np.float64)
        array = np.ascontiguousarray(given, dtype=wanted)
        if isinstance(values, np.ndarray) and not np.shares_memory(array, values) and array.size:
            self.copied.append(name)
        if shape is not None and (array.ndim != len(shape) or any(
                n is not None and n != m for n, m in zip(shape, array.shape))):
            words = ", ".join("n" if n is None else str(n) for n in shape)
            raise Error(f"{name}: an array of shape {array.shape}; give ({words})")
        return array

    def _set_points(self, points):
        self._native.set_points(self._array(points, "points", REALS, (None, 3)))

    def _set_cells(self, cells):
        if isinstance(cells, dict):
            self._set_cells_by_type(cells)
        elif isinstance(cells, tuple):
            if len(cells) not in (3, 5):
                raise Error(f"a tuple of {len(cells)} arrays: give (connectivity, offsets, types), "
                            "for polyhedra with (..., faces, face_locations)")
            self._set_vtk_cells(*cells)
        else:
            rows = np.asarray(cells)
            if rows.ndim != 2 or rows.shape[1] not in TYPE_OF_COLUMNS:
                raise Error(f"cells: an array of shape {rows.shape}; give (n, 4) for tetrahedra, 5 "
                            "for pyramids, 6 for wedges, 8 for hexahedra, or a dict by type")
            self._set_cells_by_type({TYPE_OF_COLUMNS[rows.shape[1]]: cells})

    def _set_vtk_cells(self, connectivity, offsets, types, faces=None, locations=None):
        self._native.set_cells(
            self._array(types, "types", (np.dtype(np.uint8),), (None,)),
            self._array(offsets, "offsets", INTEGERS, (None,)),
            self._array(connectivity, "connectivity", INTEGERS, (None,)))
        if faces is not None and len(faces):
            self._native.set_polyhedra(
                self._array(faces, "faces", INTEGERS, (None,)),
                self._array(locations, "face locations", INTEGERS, (None,)))

    def _set_cells_by_type(self, cells):
        blocks = []
        for kind, rows in cells.items():
            number = CELL_TYPES.get(kind, kind)
            if number not in POINTS_OF_TYPE:
                raise Error(f"no type of cells with rows is called {kind!r}; there are "
                            f"{', '.join(CELL_TYPES)} (polyhedra: as (connectivity, offsets, "
                            "types, faces, face_locations))")
            columns = POINTS_OF_TYPE[number]
            name = "connectivity" if len(cells) == 1 else f"cells '{kind}'"
            blocks.append((number, columns, self._array(rows, name, INTEGERS, (None, columns))))
        if not blocks:
            raise Error("cells: the dict is empty")
        if len(blocks) == 1:
            number, _, rows = blocks[0]
            self._native.set_cells(np.array([number], np.uint8), None, rows.reshape(-1))
            return
        # Several types: one list has to be made of them.
        self.copied += [f"cells '{kind}'" for kind in cells if f"cells '{kind}'" not in self.copied]
        connectivity = np.concatenate([rows.reshape(-1) for _, _, rows in blocks])
        counts = np.concatenate([np.full(len(rows), columns, np.int64)
                                 for _, columns, rows in blocks])
        offsets = np.concatenate([[0], np.cumsum(counts)])
        types = np.concatenate([np.full(len(rows), number, np.uint8) for number, _, rows in blocks])
        self._native.set_cells(types, offsets, connectivity)
