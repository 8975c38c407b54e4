"""Decodes a displacement with numpy alone: the mesh of DIR, as `semireg remesh --displacement DIR` wrote it, goes to OUT.obj.

    python displacement.py DIR OUT.obj [without-residual]
"""

import sys

import numpy as np


def edges_of(faces):
    """The edges in the order in which the faces have them first, and for each face the edges from corner 0 to 1, 1 to 2 and 2 to 0."""
    sides = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, first, edge_of_side = np.unique(sides, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return edges[order], rank[edge_of_side].reshape(-1, 3)


def unit(vectors):
    """Each vector over its length; 0 where it has none."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)


def orthogonal(n):
    """For each unit vector another one, orthogonal to it; the z axis where it is 0."""
    x, y, z = n.T
    sign = np.copysign(1.0, z)
    e = -1.0 / (sign + z)
    others = np.stack([x * y * e, sign + y * y * e, -y], axis=1)
    return np.where(n.any(axis=1, keepdims=True), others, [0.0, 0.0, 1.0])


def frames(positions, edges, faces, edges_of_face):
    """Normal, direction along the edge and direction across it, for each edge."""
    a, b, c = (positions[faces[:, i]] for i in range(3))
    areas = np.zeros((len(edges), 3))
    for side in range(3):
        np.add.at(areas, edges_of_face[:, side], np.cross(b - a, c - a) / 2)
    edge = positions[edges[:, 1]] - positions[edges[:, 0]]
    normal = unit(areas)
    normal = np.where(normal.any(axis=1, keepdims=True), normal, orthogonal(unit(edge)))
    along = edge
    for _ in range(2):
        along = unit(along - (along * normal).sum(axis=1, keepdims=True) * normal)
    along = np.where(along.any(axis=1, keepdims=True), along, orthogonal(normal))
    return normal, along, np.cross(normal, along)


def numbers(arrays, name, level):
    """The numbers of a level; what is quantised is multiplied by its step."""
    values, step = arrays[f"{name}_{level}"], f"{name}_step_{level}"
    return values * arrays[step] if step in arrays else values


def decoded(arrays, with_residual=True):
    """Positions and faces of the finest level."""
    positions, faces = arrays["base_positions"], arrays["base_faces"]
    level = 1
    while f"scalar_{level}" in arrays:
        edges, edges_of_face = edges_of(faces)
        ab, bc, ca = (edges_of_face + len(positions)).T
        normal, along, across = frames(positions, edges, faces, edges_of_face)
        new = positions[edges].mean(axis=1) + numbers(arrays, "scalar", level)[:, None] * normal
        if with_residual:
            r = numbers(arrays, "residual", level)
            new = new + r[:, :1] * along + r[:, 1:] * across
        a, b, c = faces.T
        children = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [bc, ca, ab]]
        faces = np.array(children).transpose(2, 0, 1).reshape(-1, 3)
        positions = np.concatenate([positions, new])
        level += 1
    return positions, faces


if __name__ == "__main__":
    folder, out = sys.argv[1:3]
    positions, faces = decoded(np.load(f"{folder}/displacement.npz"), "without-residual" not in sys.argv[3:])
    with open(out, "w") as file:
        file.writelines(f"v {float(x)!r} {float(y)!r} {float(z)!r}\n" for x, y, z in positions)
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in faces + 1)
