"""From linear floats to what a screen shows."""

import numpy as np

from ._plume import Error


def to_srgb(image, background=(1, 1, 1)):
    """An (h, w, 4) picture on a background, as (h, w, 3) bytes for a screen or a file.

    `background` is a display colour, three numbers from 0 to 1. Pictures are linear and
    premultiplied; this composites them and encodes the result by sRGB's transfer curve.
    """
    image = np.asarray(image)
    if image.ndim != 3 or image.shape[2] != 4:
        raise Error(f"an image of shape {image.shape}; give (height, width, 4)")
    back = np.asarray(background, float)
    back = np.where(back <= 0.04045, back / 12.92, ((back + 0.055) / 1.055) ** 2.4)
    linear = np.clip(image[..., :3] + (1 - image[..., 3:]) * back, 0, 1)
    display = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.rint(255 * display).astype(np.uint8)


def write_ppm(file, image, background=(1, 1, 1)):
    """Writes a picture as a .ppm file, which needs no further library.

    With Pillow, ``PIL.Image.fromarray(plume.to_srgb(image)).save("picture.png")``.
    """
    pixels = to_srgb(image, background)
    with open(file, "wb") as out:
        out.write(b"P6\n%d %d\n255\n" % (pixels.shape[1], pixels.shape[0]))
        out.write(pixels.tobytes())
