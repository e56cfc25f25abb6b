"""Runs the delmesh command and reads its JSON: the only way in which experiments use the project."""

import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "experiments" / "out"
IMAGES = ROOT / "docs" / "images"
PAPER_MESHES = ROOT.parent / "shared" / "meshes" / "paper"


class CommandFailed(Exception):
    pass


def delmesh(*arguments, allowed=(0,)):
    """The JSON object that the command prints; an exit code outside of `allowed` is an error."""
    line = [os.environ["DELMESH"], *map(str, arguments), "--json"]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        raise CommandFailed(f"{' '.join(line)}: exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def sample(name, faces=0):
    """The path of a built-in mesh, made once."""
    path = OUT / "meshes" / f"{name}-{faces}.ply"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        delmesh("sample", name, path, "--faces", faces)
    return path


def remesh(source, name, *options, allowed=(0,)):
    """Remeshes into experiments/out/meshes/NAME.ply; returns the path and the report."""
    path = OUT / "meshes" / f"{name}.ply"
    path.parent.mkdir(parents=True, exist_ok=True)
    report = delmesh("remesh", source, path, *options, allowed=allowed)
    return path, report


def distance(a, b):
    """Sampled as by Metro, in per cent of the bounding-box diagonal of a: Hausdorff and mean; and the proved upper end
    of the Hausdorff distance, within 1e-5 of the diagonal where the exit code is 0."""
    report = delmesh("distance", a, b, "--bound", "1e-5", allowed=(0, 5))
    return report["hausdorff"]["percent"], report["mean"]["percent"], report["bound"]["upper_percent"]


def save_json(name, value):
    path = OUT / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
    print(f"wrote {path.relative_to(ROOT)}")


def save_csv(name, header, rows):
    path = OUT / name
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [",".join(map(str, row)) for row in [header, *rows]]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"wrote {path.relative_to(ROOT)}")
