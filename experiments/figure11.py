"""Figure 11: how many vertices feature-preserving flipping adds, against the threshold of the dihedral angle."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import quadrics
import render

ANGLES = [0, 1, 2, 3, 5, 7, 10, 15, 20, 30, 45, 60, 90, 120, 180]
COARSE_VERTICES = 600
# Plain quadric collapse takes Python a millisecond for each vertex; larger meshes come down to this by delmesh first.
HALFWAY_VERTICES = 12000


def coarse_version(source, name):
    """600 vertices by plain quadric simplification, as the paper's QSlim: `delmesh simplify` would hand out a mesh
    that is Delaunay already."""
    path = command.OUT / "meshes" / f"{name}-coarse.off"
    if command.delmesh("stats", source)["mesh"]["vertices"] > HALFWAY_VERTICES:
        halfway = command.OUT / "meshes" / f"{name}-halfway.ply"
        command.delmesh("simplify", source, halfway, "--vertices", HALFWAY_VERTICES)
        source = halfway
    mesh_file.write_off(path, *quadrics.simplify(*mesh_file.read_mesh(source), COARSE_VERTICES))
    return path


def growth(source, name):
    rows = []
    for angle in ANGLES:
        report = command.remesh(source, f"figure11-{name}", "--mode", "feature", "--feature-angle", angle)[1]
        before, after = report["input"]["mesh"]["vertices"], report["output"]["mesh"]["vertices"]
        rows.append((angle, before, after, 100 * (after - before) / before))
    return rows


def run():
    sources = [("noisy-surface", command.sample("noisy-surface", 20000)),
               ("terrain", command.sample("terrain", 20000))]
    isis = command.PAPER_MESHES / "made-standin-isis-e562926.ply"
    if isis.exists():
        sources.insert(0, ("Isis stand-in", isis))
    figure, axes = pyplot.subplots(1, len(sources), figsize=(4.4 * len(sources), 3.4), dpi=100, squeeze=False)
    table = []
    for axis, (name, source) in zip(axes[0], sources):
        stem = name.replace(" ", "-").lower()
        for label, path in ((name, source), (f"{name}, {COARSE_VERTICES} vertices", coarse_version(source, stem))):
            rows = growth(path, stem)
            table += [(label, *row) for row in rows]
            axis.plot([r[0] for r in rows], [r[3] for r in rows], marker="o", markersize=3,
                      label=f"{rows[0][1]:,} vertices")
        axis.set(title=name, xlabel="threshold of the dihedral angle, degrees", ylabel="vertices added, %",
                 xlim=(0, 90))
        axis.set_yscale("symlog", linthresh=0.1)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.tight_layout()
    render.save(figure, command.OUT / "figure11.png")
    command.save_csv("figure11.csv", ["mesh", "threshold_deg", "vertices_before", "vertices_after", "growth_percent"],
                     table)
    print("wrote experiments/out/figure11.png")
