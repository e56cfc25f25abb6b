"""A small software renderer: flat shaded triangles with coloured edges and dots, by depth buffer."""

import io

import numpy as np
from PIL import Image

RED = (0.84, 0.10, 0.11)
BLUE = (0.12, 0.35, 0.80)
GREY = (0.30, 0.32, 0.36)
SKIN = (0.86, 0.88, 0.91)
GREEN = (0.05, 0.45, 0.25)


class View:
    """Orthographic; looks from `direction` towards the middle, or at `centre` with `extent` from top to bottom."""

    def __init__(self, points, direction, up=(0, 0, 1), centre=None, extent=None, margin=1.06):
        back = np.asarray(direction, float) / np.linalg.norm(direction)
        right = np.cross(up, back)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(back, right), back])
        seen = points @ self.axes.T
        low, high = seen.min(axis=0), seen.max(axis=0)
        self.centre = (low + high)[:2] / 2 if centre is None else (self.axes @ np.asarray(centre, float))[:2]
        self.size = (high - low)[:2] * margin if extent is None else np.array([extent, extent])
        self.back = back

    def project(self, points, width, height):
        scale = min(width / self.size[0], height / self.size[1])
        seen = points @ self.axes.T
        x = (seen[:, 0] - self.centre[0]) * scale + width / 2
        y = height / 2 - (seen[:, 1] - self.centre[1]) * scale
        return np.stack([x, y, seen[:, 2] * scale], axis=1)


def shade(points, faces, view, colour=SKIN):
    """One colour for each face, lit from the upper left and from behind the eye; both sides alike."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / np.where(length > 0, length, 1)
    normal = np.where((normal @ view.back < 0)[:, None], -normal, normal)
    light = view.axes.T @ np.array([-0.45, 0.65, 0.62])
    lit = 0.42 + 0.40 * np.clip(normal @ light, 0, 1) + 0.22 * (normal @ view.back)
    return np.clip(lit[:, None] * np.asarray(colour), 0, 1)


def render(points, faces, view, width, height, face_colours=None, edge_colours=None, edge_widths=None, dots=None,
           dot_radius=3.0, dot_colour=RED, samples=3):
    """An image (height, width, 3) in 0..1. Edges: colour (F, 3, 3) and width in pixels (F, 3), 0 for none; side i of a
    face runs from corner i to corner i + 1."""
    w, h = width * samples, height * samples
    seen = view.project(points, w, h)
    colours = shade(points, faces, view) if face_colours is None else face_colours
    image = np.ones((h, w, 3), np.float32)
    depth = np.full((h, w), -np.inf)
    for f, corners in enumerate(faces):
        _draw(image, depth, seen[corners], colours[f], None if edge_colours is None else edge_colours[f],
              None if edge_widths is None else edge_widths[f] * samples / 2)
    if dots is not None:
        for x, y, z in seen[dots]:
            _draw_dot(image, depth, x, y, z, dot_radius * samples, dot_colour)
    return image.reshape(height, samples, width, samples, 3).mean(axis=(1, 3))


def _draw(image, depth, corners, colour, edge_colours, half_widths):
    height, width = depth.shape
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0:
        return
    x0, x1 = max(int(min(ax, bx, cx)), 0), min(int(max(ax, bx, cx)) + 2, width)
    y0, y1 = max(int(min(ay, by, cy)), 0), min(int(max(ay, by, cy)) + 2, height)
    if x0 >= x1 or y0 >= y1:
        return
    x = np.arange(x0, x1)[None, :] + 0.5
    y = np.arange(y0, y1)[:, None] + 0.5
    u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
    v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
    w = 1 - u - v
    z = u * az + v * bz + w * cz
    inside = (u >= 0) & (v >= 0) & (w >= 0) & (z > depth[y0:y1, x0:x1])
    if not inside.any():
        return
    depth[y0:y1, x0:x1][inside] = z[inside]
    block = np.broadcast_to(np.asarray(colour, np.float32), (*inside.shape, 3)).copy()
    if edge_colours is not None:
        sides = ((w, ax, ay, bx, by), (u, bx, by, cx, cy), (v, cx, cy, ax, ay))
        for i in np.argsort(half_widths):
            share, px, py, qx, qy = sides[i]
            length = np.hypot(qx - px, qy - py)
            if half_widths[i] > 0 and length > 0:
                block[np.abs(share * area) / length < half_widths[i]] = edge_colours[i]
    image[y0:y1, x0:x1][inside] = block[inside]


def _draw_dot(image, depth, cx, cy, cz, radius, colour):
    height, width = depth.shape
    x0, x1 = max(int(cx - radius), 0), min(int(cx + radius) + 2, width)
    y0, y1 = max(int(cy - radius), 0), min(int(cy + radius) + 2, height)
    if x0 >= x1 or y0 >= y1 or not 0 <= int(cx) < width or not 0 <= int(cy) < height:
        return
    if depth[int(cy), int(cx)] > cz + 4 * radius:
        return
    x = np.arange(x0, x1)[None, :] + 0.5
    y = np.arange(y0, y1)[:, None] + 0.5
    image[y0:y1, x0:x1][(x - cx) ** 2 + (y - cy) ** 2 < radius**2] = colour


def uniform_edges(faces, colour=GREY, width=1.0):
    return np.tile(np.asarray(colour, float), (len(faces), 3, 1)), np.full(faces.shape, float(width))


def save(figure, path, colours=128):
    """A PNG with a palette: a third of the bytes, and no difference to be seen."""
    path.parent.mkdir(parents=True, exist_ok=True)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", bbox_inches="tight", pad_inches=0.05)
    Image.open(buffer).convert("RGB").quantize(colours, dither=Image.Dither.NONE).save(path, optimize=True)
