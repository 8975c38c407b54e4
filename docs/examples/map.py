"""Uses the map of a result: rebuilds the result from the input, carries functions both ways, and goes from level to level.

    semireg remesh INPUT -o out.obj --all-levels --map map.npz
    python3 map.py INPUT.obj out.obj map.npz [out.0.obj]

Needs numpy alone. INPUT is an obj. Ends with 1 where anything is not as docs/map.md says.
"""

import sys

import numpy as np


def read_obj(path):
    """Vertices, and triangles as indices: polygons are cut into fans, in order, as semireg does."""
    vertices, triangles = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [c - 1 if c > 0 else len(vertices) + c for c in corners]
                triangles += [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
    return np.array(vertices), np.array(triangles)


def rebuilt(vertices, triangles, triangle, barycentric, offset):
    """The points at these barycentric coordinates, moved off their triangles by the offset."""
    a, b, c = (vertices[triangles[triangle, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return a + barycentric[:, 1:2] * (b - a) + barycentric[:, 2:3] * (c - a) + offset[:, None] * normal


def carried(values, triangles, triangle, barycentric):
    """The values of vertices, interpolated at points in triangles: NaN where a point has no triangle."""
    weights = np.clip(barycentric, 0, None)  # feet beside their triangle: nothing is extrapolated
    weights = weights / weights.sum(axis=1, keepdims=True)
    return np.einsum("ik,ik...->i...", weights, values[triangles[triangle]])


def prolonged(map, level, values):
    """Values of a level at the vertices of the next: linear subdivision. With scipy, this is
    csr_matrix((data, indices, indptr), shape) @ values."""
    data, indices, indptr, shape = (map[f"prolongation_{level}_{part}"] for part in ["data", "indices", "indptr", "shape"])
    rows = np.repeat(np.arange(shape[0]), np.diff(indptr))
    result = np.zeros((shape[0], *values.shape[1:]))
    np.add.at(result, rows, (data * values[indices].T).T)
    return result


def level_faces(faces, steps):
    """The faces of the level so many steps above: corner k of face f is the first corner of its child 4f + k."""
    for _ in range(steps):
        faces = faces[:, 0].reshape(-1, 4)[:, :3]
    return faces


def subdivided(vertices, faces):
    """One step of linear subdivision, by its definition: the middles of all edges, numbered as `faces` (those of the finer level) says."""
    n = len(vertices)
    coarse = level_faces(faces, 1)
    finer = np.full((faces.max() + 1, 3), np.nan)
    finer[:n] = vertices
    for corner in range(3):
        # The face in the middle has the middles of bc, ca and ab.
        middle = faces[3::4][:, corner]
        finer[middle] = (vertices[coarse[:, (corner + 1) % 3]] + vertices[coarse[:, (corner + 2) % 3]]) / 2
    return finer


def check(name, holds, figure=""):
    print(f"{'ok  ' if holds else 'WRONG'} {name} {figure}")
    return holds


def main(input_path, output_path, map_path, base_path=None):
    vertices, triangles = read_obj(input_path)
    out_vertices, out_faces = read_obj(output_path)
    map = np.load(map_path)
    kept = map["result_face"] >= 0
    used = vertices[kept]
    diagonal = np.linalg.norm(used.max(axis=0) - used.min(axis=0))
    # The last bit of the greatest coordinate is the most that any file can tell.
    tolerance = 1e-12 * diagonal + 4 * np.finfo(float).eps * np.abs(used).max()
    good = []

    again = rebuilt(vertices, triangles, map["source_face"], map["source_barycentric"], map["offset"])
    error = np.linalg.norm(again - out_vertices, axis=1).max()
    good.append(check("every output vertex is rebuilt", error <= tolerance, f"to {error / diagonal:.1e} of the diagonal"))

    # A function of space, so that it is known on both sides: what is carried is off by what it changes over an edge, not more.
    function = lambda points: np.sin(points @ [1.0, 2.0, 3.0] / diagonal)
    safe = np.where(np.isfinite(vertices), vertices, 0)
    there = carried(function(safe), triangles, map["source_face"], map["source_barycentric"])
    difference = np.abs(there - function(out_vertices))
    good.append(check("a function is carried to the output", difference.mean() < 0.05, f"off by {difference.mean():.1e} in the mean"))
    back = carried(there, out_faces, map["result_face"], map["result_barycentric"])
    difference = np.abs(back - function(safe))[kept]
    good.append(check("and back to the input", difference.mean() < 0.05, f"off by {difference.mean():.1e} in the mean"))
    good.append(check("vertices that a repair took away have no value", np.isnan(back[~kept]).all(), f"({(~kept).sum()} of {len(kept)})"))

    levels = sum(name.startswith("parents_") for name in map.files)
    n_base = len(out_faces) >> (2 * levels)
    good.append(check("faces know their base face", (map["base_face"] == np.arange(len(out_faces)) // 4**levels).all(), f"({n_base} of them)"))
    n = level_faces(out_faces, levels).max() + 1
    values = by_definition = out_vertices[:n]
    if base_path is not None:
        good.append(check("level 0 is the file of the base mesh", (read_obj(base_path)[0] == values).all(), f"({n} vertices)"))
    for level in range(levels):
        faces = level_faces(out_faces, levels - level - 1)
        values, by_definition = prolonged(map, level, values), subdivided(by_definition, faces)
        parents = map[f"parents_{level + 1}"]
        same = (values == by_definition).all() and (values == values[parents].mean(axis=1)).all() and len(values) == faces.max() + 1
        good.append(check(f"the prolongation of level {level} is its linear subdivision", same, f"({len(values)} vertices)"))
        good.append(check("and faces know their parents", (map[f"face_parents_{level + 1}"] == np.arange(len(faces)) // 4).all()))
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
