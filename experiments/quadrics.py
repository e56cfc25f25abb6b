"""Plain quadric simplification (Garland, Heckbert 1997): makes the coarse inputs of Figure 11, and what Figure
12 is compared with. Small, not fast."""

import heapq

import numpy as np


def simplify(points, faces, vertices):
    """Collapses the cheapest edge until `vertices` are left; keeps the manifold, keeps boundaries by steep planes."""
    mesh = _Collapser(points, faces)
    mesh.run(vertices)
    return mesh.result()


class _Collapser:
    def __init__(self, points, faces):
        self.points = [p for p in np.array(points, float)]
        self.faces = {i: list(map(int, f)) for i, f in enumerate(faces)}
        self.star = [set() for _ in self.points]
        for i, corners in self.faces.items():
            for v in corners:
                self.star[v].add(i)
        self.version = [0] * len(self.points)
        self.alive = [bool(s) for s in self.star]
        self.quadric = self._quadrics()
        self.heap = []
        for a in range(len(self.points)):
            for b in self._ring(a):
                if a < b:
                    self._push(a, b)

    def _quadrics(self):
        quadric = [np.zeros((4, 4)) for _ in self.points]
        for corners in self.faces.values():
            a, b, c = (self.points[v] for v in corners)
            normal = np.cross(b - a, c - a)
            area = np.linalg.norm(normal)
            if area > 0:
                self._add_plane(quadric, corners, normal / area, a, area)
            for i in range(3):
                p, q = corners[i], corners[(i + 1) % 3]
                if area > 0 and len(self.star[p] & self.star[q]) == 1:
                    side = self.points[q] - self.points[p]
                    wall = np.cross(normal / area, side)
                    length = np.linalg.norm(wall)
                    self._add_plane(quadric, (p, q), wall / length, self.points[p], 10 * length**2)
        return quadric

    @staticmethod
    def _add_plane(quadric, corners, normal, point, weight):
        plane = np.append(normal, -normal @ point)
        for v in corners:
            quadric[v] += weight * np.outer(plane, plane)

    def _ring(self, v):
        return {w for f in self.star[v] for w in self.faces[f]} - {v}

    def _push(self, a, b):
        q = self.quadric[a] + self.quadric[b]
        candidates = [self.points[a], self.points[b], (self.points[a] + self.points[b]) / 2]
        if abs(np.linalg.det(q[:3, :3])) > 1e-12 * np.trace(q[:3, :3]) ** 3:
            candidates.append(np.linalg.solve(q[:3, :3], -q[:3, 3]))
        costs = [np.append(p, 1) @ q @ np.append(p, 1) for p in candidates]
        best = int(np.argmin(costs))
        item = (float(costs[best]), a, b, self.version[a], self.version[b], tuple(candidates[best]))
        heapq.heappush(self.heap, item)

    def run(self, vertices):
        count = sum(self.alive)
        while count > vertices and self.heap:
            _, a, b, version_a, version_b, place = heapq.heappop(self.heap)
            if not (self.alive[a] and self.alive[b]) or (self.version[a], self.version[b]) != (version_a, version_b):
                continue
            if self._allowed(a, b, np.array(place)):
                self._collapse(a, b, np.array(place))
                count -= 1

    def _allowed(self, a, b, place):
        shared = self.star[a] & self.star[b]
        thirds = {w for f in shared for w in self.faces[f]} - {a, b}
        if self._ring(a) & self._ring(b) != thirds or len(self.star[a] | self.star[b]) - len(shared) < 3:
            return False
        boundary = [any(len(self.star[v] & self.star[w]) == 1 for w in self._ring(v)) for v in (a, b)]
        if all(boundary) and len(shared) != 1:
            return False
        return all(self._keeps_side(f, v, place) for v in (a, b) for f in self.star[v] - shared)

    def _keeps_side(self, f, moved, place):
        old = [self.points[v] for v in self.faces[f]]
        new = [place if v == moved else self.points[v] for v in self.faces[f]]
        before = np.cross(old[1] - old[0], old[2] - old[0])
        after = np.cross(new[1] - new[0], new[2] - new[0])
        return before @ after > 0.2 * np.linalg.norm(before) * np.linalg.norm(after)

    def _collapse(self, a, b, place):
        for f in self.star[a] & self.star[b]:
            for v in self.faces.pop(f):
                self.star[v].discard(f)
        for f in self.star[b]:
            self.faces[f][self.faces[f].index(b)] = a
        self.star[a] |= self.star[b]
        self.star[b] = set()
        self.alive[b] = False
        self.points[a] = place
        self.quadric[a] = self.quadric[a] + self.quadric[b]
        self.version[a] += 1
        for w in self._ring(a):
            self._push(min(a, w), max(a, w))

    def result(self):
        used = sorted({v for f in self.faces.values() for v in f})
        number = {v: i for i, v in enumerate(used)}
        return (np.array([self.points[v] for v in used]),
                np.array([[number[v] for v in self.faces[f]] for f in sorted(self.faces)]))
