"""Plume: pictures of the meshes that CFD codes write, cell by cell, without resampling.

One picture of arrays that are there::

    import plume
    image = plume.render(points, cells, field)     # (height, width, 4) floats, linear RGBA
    plume.write_ppm("picture.ppm", image)

``points`` are (n, 3) coordinates; ``cells`` are (m, 4) numbers of points for tetrahedra, (m, 8) for
hexahedra, a dict by type, or VTK's (connectivity, offsets, types); ``field`` has a value for each
point or each cell. A mesh of PyVista or VTK goes in as it is: ``plume.render(mesh)``.

For many pictures of one mesh, for other fields on it, and for depth and other channels, make a
:class:`Scene`.

Arrays of float32, float64, int32 and int64 are read where they are, never copied and never
written to; pictures come out as NumPy arrays that own their memory. What is wrong raises
:class:`plume.Error`, a ValueError whose message says what to do about it.
"""

from ._plume import Camera, Error, version as _version
from ._mesh import Mesh
from ._picture import to_srgb, write_ppm
from ._scene import Picture, Scene, render
from . import _plume

__version__ = _version()

#: Names of the colour maps that there are.
COLOR_MAPS = tuple(_plume.color_maps())
#: Names of the views that a camera can be fitted to.
VIEWS = tuple(_plume.views())

__all__ = [
    "COLOR_MAPS", "VIEWS", "Camera", "Error", "Mesh", "Picture", "Scene", "render", "to_srgb",
    "write_ppm",
]
