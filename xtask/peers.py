"""Remeshing by other people's programs, for the bench: what anyone can install from PyPI.

peers.py TOOL INPUT VERTICES TRIANGLES OUTPUT writes a mesh of about so many triangles and prints {"processor_seconds": S} as JSON: of the
call that made it, without starting Python, reading and writing. A tool that takes an edge length is called twice; the second
length comes from what the first one gave, and the second call counts.
"""

import json
import sys
import time

import numpy as np
import trimesh


def isotropic(mesh, _, n_triangles):
    import pymeshlab

    def remesh(length):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(mesh.vertices, mesh.faces))
        meshes.meshing_isotropic_explicit_remeshing(targetlen=pymeshlab.PureValue(length), iterations=10)
        made = meshes.current_mesh()
        return made.vertex_matrix(), made.face_matrix()

    return by_length(mesh, n_triangles, remesh)


def botsch(mesh, _, n_triangles):
    import gpytoolbox

    points, faces = np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int32)
    return by_length(mesh, n_triangles, lambda length: gpytoolbox.remesh_botsch(points, faces, i=10, h=length, project=True))


def by_length(mesh, n_triangles, remesh):
    # Of equilateral triangles.
    length = np.sqrt(4 / np.sqrt(3) * mesh.area / n_triangles)
    made = remesh(length)
    length *= np.sqrt(len(made[1]) / n_triangles)
    start = time.process_time()
    return *remesh(length), time.process_time() - start


def acvd(mesh, n_vertices, _):
    import pyacvd
    import pyvista

    surface = pyvista.PolyData.from_regular_faces(np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces))
    start = time.process_time()
    clustering = pyacvd.Clustering(surface)
    # Clusters of few triangles come out ragged: pyacvd's manual asks for ten input vertices a cluster and more.
    while len(clustering.mesh.points) < 10 * n_vertices:
        clustering.subdivide(1)
    clustering.cluster(n_vertices)
    made = clustering.create_mesh()
    return made.points, made.regular_faces, time.process_time() - start


def main():
    tool, path, n_vertices, n_triangles, output = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), sys.argv[5]
    mesh = trimesh.load(path, process=False, force="mesh")
    mesh.merge_vertices()
    remesh = {"isotropic": isotropic, "botsch": botsch, "acvd": acvd}[tool]
    points, faces, seconds = remesh(mesh, n_vertices, n_triangles)
    trimesh.Trimesh(points, faces, process=False).export(output)
    print(json.dumps({"processor_seconds": seconds}))


if __name__ == "__main__":
    main()
