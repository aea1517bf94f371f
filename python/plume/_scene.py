"""From a mesh to pictures."""

import numpy as np

from . import _plume
from ._mesh import Mesh
from ._plume import Error

_FIELD = "field"  # of fields that come without a name


class Picture:
    """What :meth:`Scene.render` returns.

    Attributes
    ----------
    rgba : (height, width, 4) float32
        Linear colour, premultiplied by alpha; the first row is the top.
    channels : dict
        (height, width) float32 arrays: those that were asked for, and the numbers of a mode that
        shows some, under its name.
    statistics : dict
        Counts of rays and cells, and the "plan": what was chosen for this picture, and why.
    cancelled : bool
        Whether `progress` asked to stop: the picture is then incomplete.
    """

    def __init__(self, rgba, channels, statistics, cancelled):
        self.rgba, self.channels = rgba, channels
        self.statistics, self.cancelled = statistics, cancelled

    def __repr__(self):
        height, width, _ = self.rgba.shape
        return f"<plume.Picture of {width} x {height} pixels; channels: {list(self.channels)}>"


class Scene:
    """A mesh made ready to be traced, one of its fields, and what the values look like.

    Parameters
    ----------
    mesh : Mesh, or a PyVista or VTK data set
        For arrays, make a :class:`Mesh` of them.
    field : str or array, optional
        "NAME", "NAME:0" (a component) or "NAME:magnitude" of one of the mesh's fields; by default
        its first. An array becomes a field.
    cell_data : "constant" or "averaged"
        Whether a field of cells is constant in each, or averaged to the points.
    light : bool
        Keep gradients, which light on surfaces needs: 12 bytes a point.
    fields_change : bool
        Keep what :meth:`set_field` needs: 4 bytes a point, or cell.
    cell_numbers : bool
        Keep the numbers of cells, for the channel "cell_id" and :meth:`trace`: 4 bytes a cell.
    """

    def __init__(self, mesh, field=None, *, cell_data="constant", light=False, fields_change=False,
                 cell_numbers=False):
        if not isinstance(mesh, Mesh):
            mesh = Mesh(mesh)
        self._name = self._field_name(mesh, field)
        self._native = _plume.Scene(mesh._native, self._name, cell_data, light, fields_change,
                                    cell_numbers)
        self._mesh = mesh if fields_change else None
        self._lit = light
        self._rows = ([], [], True)

    def set_field(self, field=None):
        """Shows another field of the mesh, or new values of the same.

        `field` is a name or an array; None reads the same array again, which may hold other values
        by now. Nothing is rebuilt but what depends on the values, and what they look like stays:
        call :meth:`set_colors` for a new look. Needs ``fields_change=True``.
        """
        if self._mesh is None:
            raise Error("a scene whose fields change needs to know: Scene(..., fields_change=True)")
        name = self._name if field is None else self._field_name(self._mesh, field)
        self._native.set_field(self._mesh._native, name)
        self._name = name

    @staticmethod
    def _field_name(mesh, field):
        if field is None or isinstance(field, str):
            return field or ""
        mesh._native.remove_field(_FIELD)
        mesh.add_field(_FIELD, field)
        return _FIELD

    @property
    def field(self):
        """Name, association, range and count of values that are not finite, as a dict."""
        return self._native.field()

    @property
    def bounds(self):
        """((x0, y0, z0), (x1, y1, z1)), in world units."""
        low, high = self._native.bounds()
        return tuple(low), tuple(high)

    @property
    def findings(self):
        """What was found on the way that a user should know, in words."""
        return self._native.findings()

    @property
    def bytes(self):
        """Memory of the mesh as it is traced."""
        return self._native.bytes()

    def __repr__(self):
        return (f"<plume.Scene of {self._native.cell_count()} cells, walked as "
                f"{self._native.form()}; field: {self.field['name']}>")

    def set_colors(self, name=None, range=None, *, opacities=None, unit_distance=None,
                   opacity_scale=1.0):
        """Chooses a colour map for the volume.

        Parameters
        ----------
        name : str, optional
            One of plume.COLOR_MAPS; by default one that is fitted to the field.
        range : (low, high), optional
            The values at its ends; by default the field's range.
        opacities : rows of (value, opacity), optional
            Opacity over the field's values, 0 to 1; by default it rises from 0 to 1 over the range.
        unit_distance : float, optional
            The distance over which opacity applies, in world units; by default one fitted to the
            mesh.
        opacity_scale : float
            A factor of all opacity.
        """
        rows = [(float(x), float(opacity)) for x, opacity in (opacities or [])]
        self._native.set_color_map(name, range, rows, unit_distance, float(opacity_scale))
        self._native.set_surfaces(*self._tables())

    def set_transfer_function(self, knots):
        """Chooses extinction and colour of the volume, piecewise linear over the scalar.

        `knots` are rows of (scalar, extinction per world unit, r, g, b), the scalar ascending, the
        colour linear. Two knots at one scalar make a step.
        """
        self._native.set_transfer_function(knots)
        self._native.set_surfaces(*self._tables())

    def set_surfaces(self, isosurfaces=(), intervals=(), *, volume=True):
        """Shows isosurfaces and interval volumes.

        Parameters
        ----------
        isosurfaces : rows of (value, opacity, r, g, b)
            Opacity from 0 to 1, of each crossing; linear colour.
        intervals : rows of (low, high, opacity, r, g, b)
            All between two values, as opaque wherever a ray crosses it, however thick.
        volume : bool
            Whether the volume is seen besides.
        """
        self._rows = (list(isosurfaces), list(intervals), bool(volume))
        self._native.set_surfaces(*self._tables())

    def _tables(self):
        isosurfaces, intervals, volume = self._rows
        def table(rows, columns):
            return np.asarray(rows, np.float32).reshape(len(rows), -1 if rows else columns)

        return table(isosurfaces, 5), table(intervals, 6), volume

    def camera(self, view="iso", aspect_ratio=4 / 3, *, azimuth=0.0, elevation=0.0, zoom=1.0):
        """A camera that sees all of the scene.

        `view` is one of plume.VIEWS: "+x" looks along +x; "iso" along (-1, -1, -1). `azimuth` and
        `elevation` turn it about the scene, in degrees; `zoom` above 1 makes things larger.
        `aspect_ratio` is that of the picture, width / height.
        """
        camera = self._native.view(view, float(aspect_ratio))
        if azimuth or elevation:
            camera = _plume.orbit(camera, float(azimuth), float(elevation))
        return camera if zoom == 1 else _plume.zoom(camera, float(zoom))

    def render(self, size=(1024, 768), *, camera="iso", mode="volume", order=1, tolerance=None,
               light=None, clip=(), channels=(), early_termination=1e-4, threads=0, progress=None):
        """Renders a :class:`Picture`. Other Python threads run meanwhile; Ctrl-C interrupts.

        Parameters
        ----------
        size : (width, height)
            Pixels, 1 to 65536 each.
        camera : Camera or str
            As from :meth:`camera`, or the name of a view.
        mode : str
            What a pixel shows: emission and absorption ("volume"), or one number a ray, which is
            then in the channel of the mode's name: the greatest value along the ray ("maximum"),
            the least ("minimum"), the field's integral along it ("integral") or that by the ray's
            length in the mesh ("average"), the distance to what is seen first ("depth"), the
            volume's "optical_depth", or how many cells there are ("cell_count").
        order : 1, 2 or 3
            The scalar inside of cells that are no tetrahedra is linear, quadratic or cubic along a
            ray.
        tolerance : float, optional
            The greatest error of a channel, in [0, 1), in the place of `order` and
            `early_termination`: both are then chosen for the picture, and its "plan" says how.
        light : bool or (x, y, z), optional
            Light on surfaces from the viewer or from a direction; by default where the scene was
            made with ``light=True``.
        clip : rows of (x, y, z, nx, ny, nz)
            Planes by a point and a normal: only the side that all normals point to is seen.
        channels : names
            "depth", "optical_depth", "cell_id", "cell_count"; of surfaces "isovalue", "normal".
        early_termination : float
            The transmittance below which a ray ends, in [0, 1).
        threads : int
            How many to use; 0 for all. The picture is the same for any number.
        progress : function, optional
            Called with the share done, from 0 to 1; False cancels.
        """
        width, height = (int(n) for n in size)
        arguments = _plume.RenderArguments()
        arguments.set_size(width, height)
        arguments.set_mode(mode)
        arguments.set_order(int(order))
        if tolerance is not None:
            arguments.set_tolerance(float(tolerance))
        if light is None:
            light = self._lit
        if light is not False:
            if not self._lit:
                raise Error("light needs gradients of the field: Scene(..., light=True)")
            arguments.set_lights([None if light is True else tuple(map(float, light))])
        for plane in clip:
            x, y, z, nx, ny, nz = (float(number) for number in plane)
            arguments.add_clip_plane((x, y, z), (nx, ny, nz))
        arguments.channels = list(channels)
        arguments.early_termination = float(early_termination)
        arguments.threads = int(threads)
        arguments.progress = progress
        if isinstance(camera, str):
            camera = self.camera(camera, width / height if height > 0 else 1)
        return Picture(*self._native.render(camera, arguments))

    def trace(self, origin, direction, order=1):
        """The segments of a ray, front to back.

        Returns ``(t, s, cells)``: (n, 2) distances along the ray where it comes into each cell and
        goes out, the scalar at both, and the cells' numbers (of the mesh where the scene was made
        with ``cell_numbers=True`` or the mesh is a grid). Distances are in lengths of `direction`.
        Above order 1 the ends are the same: what lies between is not returned.
        """
        return self._native.trace(tuple(map(float, origin)), tuple(map(float, direction)), order)


def render(points, cells=None, field=None, *, size=(1024, 768), camera="iso", colors=None,
           range=None, opacity_scale=1.0, mode="volume", **mesh):
    """Renders one picture: an (height, width, 4) float32 array, linear RGBA, premultiplied.

    Parameters
    ----------
    points, cells
        As for :class:`Mesh`; a PyVista or VTK data set comes alone.
    field : array or str, optional
        Values on points or cells, or the name of one of a data set's fields.
    size, camera, mode
        As for :meth:`Scene.render`.
    colors, range, opacity_scale
        As for :meth:`Scene.set_colors`.
    **mesh
        Further arguments of :class:`Mesh`: dimensions, axes, hidden, fields.

    For screens and files see :func:`to_srgb`.
    """
    scene = Scene(Mesh(points, cells, **mesh), field)
    if colors is not None or range is not None or opacity_scale != 1:
        scene.set_colors(colors, range, opacity_scale=opacity_scale)
    return scene.render(size, camera=camera, mode=mode).rgba
