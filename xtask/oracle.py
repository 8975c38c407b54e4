"""Distances between surfaces by libigl: the independent judge of our own measure.

oracle.py JOBS.json, a list of {name, input, output}; prints {name: {err_mean, err_rms, err_max}} as one JSON object.
As in METRO: points sampled by area on each surface, all vertices added for the greatest distance, both directions, the worse one,
over the diagonal of the input's box.
"""

import json
import sys

import igl
import numpy as np

SAMPLES = 100_000


def load(path):
    """Vertices and triangles of an obj, off, ascii ply or binary stl file, as the fixtures have them."""
    if path.endswith(".stl"):
        data = np.fromfile(path, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("pad", "<u2")]), offset=84)
        corners = data["corners"].reshape(-1, 3).astype(float)
        return corners, np.arange(len(corners)).reshape(-1, 3)
    lines = [line.split() for line in open(path)]
    if path.endswith(".obj"):
        vertices = [w[1:4] for w in lines if w[:1] == ["v"]]
        return np.array(vertices, float), np.array([[c.split("/")[0] for c in w[1:4]] for w in lines if w[:1] == ["f"]], int) - 1
    if path.endswith(".off"):
        n_vertices, n_faces = int(lines[1][0]), int(lines[1][1])
        body = lines[2:]
    else:
        count = {w[1]: int(w[2]) for w in lines if w[:1] == ["element"]}
        n_vertices, n_faces = count["vertex"], count["face"]
        body = lines[lines.index(["end_header"]) + 1 :]
    faces = [w[1:4] for w in body[n_vertices : n_vertices + n_faces]]
    return np.array([w[:3] for w in body[:n_vertices]], float), np.array(faces, int)


def sound(vertices, faces):
    """Without the triangles that cleaning drops: libigl does not survive bad indices and infinite coordinates."""
    faces = faces[((faces >= 0) & (faces < len(vertices))).all(axis=1)]
    faces = faces[np.isfinite(vertices[faces]).all(axis=(1, 2))]
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)


def sample(vertices, faces, random):
    """Points spread evenly by area."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(faces), SAMPLES, p=areas / areas.sum())
    u, v = np.sqrt(random.random(SAMPLES)), random.random(SAMPLES)
    weights = np.stack([1 - u, u * (1 - v), u * v], axis=1)
    return np.einsum("sk,skd->sd", weights, vertices[faces[chosen]])


def distances(points, vertices, faces):
    return np.sqrt(np.maximum(igl.point_mesh_squared_distance(points, vertices, faces)[0], 0))


def measure(original, remeshed):
    random = np.random.default_rng(1)
    diagonal = np.linalg.norm(np.ptp(original[0], axis=0))
    worst = np.zeros(3)
    for source, target in [(remeshed, original), (original, remeshed)]:
        at_samples = distances(sample(*source, random), *target)
        at_vertices = distances(source[0], *target)
        figures = [at_samples.mean(), np.sqrt((at_samples**2).mean()), max(at_samples.max(), at_vertices.max())]
        worst = np.maximum(worst, np.array(figures) / diagonal)
    return dict(zip(["err_mean", "err_rms", "err_max"], worst.tolist()))


jobs = json.load(open(sys.argv[1]))
print(json.dumps({job["name"]: measure(sound(*load(job["input"])), sound(*load(job["output"]))) for job in jobs}))
