"""Figure 2: Algorithm 1 at work, split by split. Physical edges red, planar edges blue."""

import json

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import render

DIRECTION = (0.06, -0.35, 1.0)

# A hip roof: two hips and two long sides, seen from above.
ROOF_POINTS = [(-3, -0.9, 0), (3, -0.9, 0), (3, 0.9, 0), (-3, 0.9, 0), (-1, 0.1, 0.4), (1.8, 0.1, 0.4)]
ROOF_FACES = [(0, 1, 5), (0, 5, 4), (1, 2, 5), (2, 3, 5), (3, 4, 5), (3, 0, 4)]


def snapshot(source, splits):
    """The mesh as it is when `splits` vertices have been added, and the facet of each face."""
    vertices = command.delmesh("stats", source)["mesh"]["vertices"]
    origin = command.OUT / "meshes" / "figure2.json"
    limit = [] if splits is None else ["--max-vertices", vertices + splits]
    path, report = command.remesh(source, "figure2", "--placement", "shells", *limit, "--keep-partial", "--provenance",
                                  origin, allowed=(0, 5))
    facets = np.array(json.loads(origin.read_text(encoding="utf-8"))["facet_of_face"])
    return *mesh_file.read_mesh(path), facets, report


def draw(points, faces, facets, vertices_before, view, size):
    twin = mesh_file.twins(faces)
    across = np.where(twin >= 0, facets[twin // 3], -1)
    physical = across != facets[:, None]
    colours = np.where(physical[..., None], render.RED, render.BLUE)
    widths = np.where(physical, 2.6, 1.8)
    new = np.arange(vertices_before, len(points))
    return render.render(points, faces, view, *size, edge_colours=colours, edge_widths=widths, dots=new, dot_radius=4,
                         dot_colour=(0.05, 0.05, 0.05))


def run():
    source = command.OUT / "meshes" / "roof.off"
    source.parent.mkdir(parents=True, exist_ok=True)
    mesh_file.write_off(source, ROOF_POINTS, ROOF_FACES)
    points, _ = mesh_file.read_mesh(source)
    view = render.View(points, DIRECTION)
    size = (300, int(300 * view.size[1] / view.size[0]))
    total = snapshot(source, None)[-1]["splits"]
    panels = [("input", None), ("planar edges flipped", 0)]
    panels += [(f"{k} splits" if k != 1 else "1 split", k) for k in (1, total // 2, total - 2)]
    panels += [(f"done: {total} splits", None)]
    figure, axes = pyplot.subplots(2, len(panels) // 2, figsize=(9.2, 3.6), dpi=100)
    data = []
    for axis, (title, splits) in zip(axes.reshape(-1), panels):
        moved, faces, facets, report = snapshot(source, splits)
        if title == "input":
            moved, faces = mesh_file.read_mesh(source)
            facets = np.array(json.loads((command.OUT / "meshes" / "figure2.json").read_text(encoding="utf-8"))
                              ["facet_of_input_face"])
        axis.imshow(draw(moved, faces, facets, len(points), view, size))
        delaunay = report["input" if title == "input" else "output"]["delaunay"]
        bad = delaunay["non_delaunay_edges"] + delaunay["obtuse_boundary_edges"]
        axis.set_title(f"{title}\n{len(moved)} vertices, {bad} edges not Delaunay", fontsize=8)
        axis.axis("off")
        data.append({"panel": title, "vertices": len(moved), "non_delaunay_edges": bad})
    figure.tight_layout(pad=0.4)
    command.OUT.mkdir(parents=True, exist_ok=True)
    render.save(figure, command.OUT / "figure2.png")
    command.save_json("figure2.json", data)
