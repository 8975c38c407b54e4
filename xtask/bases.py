"""Base meshes by other people's programs, for the ablation: decimation by quadrics, and approximated centroidal Voronoi diagrams.

bases.py INPUT N_VERTICES N_FACES FOLDER: writes qem.ply and acvd.ply of about so many triangles or vertices into the folder. One that
fails is left out, with a line on standard error.
"""

import sys
from pathlib import Path

import fast_simplification
import numpy as np
import pyacvd
import pyvista
import trimesh


def qem(mesh, n_faces):
    points = np.asarray(mesh.vertices, np.float64)
    return fast_simplification.simplify(points, np.asarray(mesh.faces, np.int32), target_count=n_faces, agg=7)


def acvd(mesh, n_vertices):
    surface = pyvista.PolyData.from_regular_faces(np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces))
    clustering = pyacvd.Clustering(surface)
    # Clusters of few triangles come out ragged: pyacvd's manual asks for ten input vertices a cluster and more.
    while len(clustering.mesh.points) < 20 * n_vertices:
        clustering.subdivide(1)
    clustering.cluster(n_vertices)
    remeshed = clustering.create_mesh()
    return remeshed.points, remeshed.regular_faces


def main():
    path, n_vertices, n_faces, folder = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4])
    mesh = trimesh.load(path, process=False, force="mesh")
    mesh.merge_vertices()
    for name, make, n in [("qem", qem, n_faces), ("acvd", acvd, n_vertices)]:
        try:
            trimesh.Trimesh(*make(mesh, n), process=False).export(folder / f"{name}.ply")
        except Exception as error:
            print(f"{name}: {error}", file=sys.stderr)


if __name__ == "__main__":
    main()
