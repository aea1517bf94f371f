"""A host program in Python: the same two tetrahedra as in embed.cpp."""

import numpy as np
import plume

points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], dtype=float)
tetrahedra = np.array([[0, 1, 2, 3], [4, 1, 3, 2]])
pressure = np.array([1, 2, 3, 4, 5], dtype=np.float32)

# One picture.
image = plume.render(points, tetrahedra, pressure, size=(64, 64))
print(f"Plume {plume.__version__}: the middle pixel is {image[32, 32, 3]:.3f} opaque")

# A scene, for more: here the integral of the pressure along the diagonal.
mesh = plume.Mesh(points, tetrahedra, fields={"pressure": pressure})
scene = plume.Scene(mesh, "pressure")
t, s, cells = scene.trace(origin=(-1, -1, -1), direction=np.full(3, 3**-0.5))
integral = (0.5 * (s[:, 0] + s[:, 1]) * (t[:, 1] - t[:, 0])).sum()
print(f"integral of the pressure along the diagonal: {integral:.6f}")
