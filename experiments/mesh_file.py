"""Reads triangle meshes into arrays: the PLY files that delmesh writes, and plain OFF."""

import numpy as np


def read_mesh(path):
    """Points as (V, 3) doubles, faces as (F, 3) indices."""
    data = path.read_bytes()
    return _read_ply(data) if data.startswith(b"ply") else _read_off(data)


def _read_ply(data):
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().split("\n")
    if "format binary_little_endian 1.0" not in lines:
        raise ValueError("not a binary PLY file as delmesh writes it")
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    real = "<f8" if any(line.startswith("property double") for line in lines) else "<f4"
    points = np.frombuffer(data, real, 3 * counts["vertex"], end).reshape(-1, 3).astype(float)
    corner = np.dtype([("n", "u1"), ("v", "<i4", 3)])
    faces = np.frombuffer(data, corner, counts["face"], end + points.size * np.dtype(real).itemsize)["v"]
    return points, faces.astype(np.int64)


def _read_off(data):
    tokens = data.split()
    if tokens[0] != b"OFF":
        raise ValueError("neither PLY nor OFF")
    vertices, faces = int(tokens[1]), int(tokens[2])
    points = np.array(tokens[4:4 + 3 * vertices], dtype=float).reshape(-1, 3)
    corners = np.array(tokens[4 + 3 * vertices:4 + 3 * vertices + 4 * faces], dtype=np.int64).reshape(-1, 4)
    return points, corners[:, 1:]


def write_off(path, points, faces):
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        out.writelines("{!r} {!r} {!r}\n".format(*map(float, p)) for p in points)
        out.writelines("3 {} {} {}\n".format(*f) for f in faces)


def twins(faces):
    """For each half-edge (face, corner) the flat index of the opposite one, -1 at the boundary."""
    count = 3 * len(faces)
    start = faces.reshape(-1)
    end = np.roll(faces, -1, axis=1).reshape(-1)
    index = {(int(a), int(b)): h for h, (a, b) in enumerate(zip(start, end))}
    twin = np.full(count, -1)
    for h in range(count):
        twin[h] = index.get((int(end[h]), int(start[h])), -1)
    return twin.reshape(-1, 3)


def opposite_angles(points, faces):
    """The angle opposite to each half-edge, in radians."""
    angles = np.empty(faces.shape)
    for corner in range(3):
        apex = points[faces[:, (corner + 2) % 3]]
        a = points[faces[:, corner]] - apex
        b = points[faces[:, (corner + 1) % 3]] - apex
        angles[:, corner] = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1))
    return angles


def non_delaunay(points, faces):
    """For each half-edge whether its edge is not Delaunay; for colours only (`delmesh check` is exact)."""
    angles = opposite_angles(points, faces)
    twin = twins(faces)
    across = np.where(twin >= 0, angles.reshape(-1)[twin], angles)
    return angles + across > np.pi * (1 + 1e-9)
