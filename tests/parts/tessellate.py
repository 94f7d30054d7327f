"""Meshes of a solid: triangles, and the B-rep face of each."""
import math
import tempfile

import gmsh
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.TopLoc import TopLoc_Location
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from unusable import Unusable

KERNEL = {"coarse": (1e-2, 0.44), "fine": (1e-3, 0.12)}  # deflection (share of diagonal), angle (rad)


def kernel_mesh(shape, diagonal, deflection, angle):
    """Points, triangles and face indices of Open CASCADE's own mesh."""
    BRepTools.Clean_s(shape.wrapped)
    BRepMesh_IncrementalMesh(shape.wrapped, deflection * diagonal, False, angle, False)
    points, triangles, owner, n = [], [], [], 0
    for index, face in enumerate(shape.Faces()):
        where = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face.wrapped, where)
        if mesh is None:
            raise Unusable(f"face {index} cannot be triangulated")
        move = where.Transformation()
        for i in range(mesh.NbNodes()):
            p = mesh.Node(i + 1).Transformed(move)
            points.append((p.X(), p.Y(), p.Z()))
        flip = face.wrapped.Orientation().name == "TopAbs_REVERSED"
        for i in range(mesh.NbTriangles()):
            a, b, c = mesh.Triangle(i + 1).Get()
            triangles.append((n + a - 1, n + c - 1, n + b - 1) if flip else (n + a - 1, n + b - 1, n + c - 1))
            owner.append(index)
        n += mesh.NbNodes()
    return np.array(points), np.array(triangles), np.array(owner)


def uniform_mesh(shape, algorithm, most=30000):
    """The same from gmsh: near-equilateral triangles of about one size, finer where it curves."""
    for curvature in (20, 12, 7):  # triangles on a full turn
        mesh = gmsh_mesh(shape, algorithm, curvature)
        if len(mesh[1]) <= most:
            break
    return mesh


def gmsh_mesh(shape, algorithm, curvature, target=9000):
    size = math.sqrt(shape.Area() * 4 / math.sqrt(3) / target)
    with tempfile.TemporaryDirectory() as folder:
        shape.exportBrep(f"{folder}/part.brep")
        gmsh.initialize(interruptible=False)
        try:
            for key, value in {"General.Verbosity": 1, "Mesh.MeshSizeMax": size, "Mesh.MeshSizeMin": size / 12,
                               "Mesh.MeshSizeFromCurvature": curvature, "Mesh.MeshSizeExtendFromBoundary": 1,
                               "Mesh.Algorithm": algorithm, "Geometry.OCCAutoFix": 0, "Mesh.RandomSeed": 1}.items():
                gmsh.option.setNumber(key, value)
            gmsh.model.occ.importShapes(f"{folder}/part.brep")
            gmsh.model.occ.synchronize()
            tags = [tag for _, tag in gmsh.model.getEntities(2)]
            faces = shape.Faces()
            areas = [gmsh.model.occ.getMass(2, tag) for tag in tags]
            if len(tags) != len(faces) or not np.allclose(areas, [f.Area() for f in faces], rtol=1e-3):
                raise Unusable("gmsh and the kernel disagree on the faces")
            gmsh.model.mesh.generate(2)
            ids, points, _ = gmsh.model.mesh.getNodes()
            place = np.zeros(int(ids.max()) + 1, int)
            place[ids] = np.arange(len(ids))
            triangles, owner = [], []
            for index, (tag, face) in enumerate(zip(tags, faces)):
                mesh = place[gmsh.model.mesh.getElementsByType(2, tag)[1]].reshape(-1, 3)
                triangles.append(mesh)
                owner.append(np.full(len(mesh), index))
        except Unusable:
            raise
        except Exception as error:
            raise Unusable(f"gmsh: {error}") from None
        finally:
            gmsh.finalize()
    return points.reshape(-1, 3), np.concatenate(triangles), np.concatenate(owner)


def orient(triangles, owner, points, faces):
    """Turns the triangles of a face round where they look inward (gmsh follows the surface, not the face)."""
    triangles = triangles.copy()
    corners = points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    for index, face in enumerate(faces):
        mine = np.flatnonzero(owner == index)
        votes = [normal[t] @ face.normal_near(corners[t, k]) for t in mine[:: len(mine) // 12 + 1] for k in range(3)]
        if np.nansum(votes) < 0:
            triangles[mine] = triangles[mine][:, ::-1]
    return triangles


def weld(points, triangles, owner, diagonal):
    """One vertex for points that coincide (within 1e-7 of the diagonal), in single precision."""
    pairs = cKDTree(points).query_pairs(1e-7 * diagonal, output_type="ndarray")
    n = len(points)
    _, cluster = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), (n, n)), directed=False)
    first = np.unique(cluster, return_index=True)[1]
    single = points[first].astype(np.float32) + np.float32(0)
    single, index = np.unique(single, axis=0, return_inverse=True)
    triangles = index.reshape(-1)[cluster[triangles]]
    proper = (triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 2] != triangles[:, 0])
    used, triangles = np.unique(triangles[proper], return_inverse=True)
    return single[used], triangles.reshape(-1, 3), owner[proper]
